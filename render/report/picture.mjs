// node picture.mjs REPORT.html OUT.jpg: the chart, variants beside the reference, and the steps of one pixel.
import { clickPixel, launch, open } from './test/browser.mjs';

const [file, out] = process.argv.slice(2);
if (!out) {
  console.error('usage: node picture.mjs REPORT.html OUT.jpg');
  process.exit(2);
}
const browser = await launch();
const { page } = await open(browser, file, { width: 1500, height: 2000 });
const size = await page.$eval('#study', node => {
  const { width, height } = JSON.parse(node.textContent);
  return { width, height };
});
await clickPixel(page, 'reference', Math.floor(size.width / 2), Math.floor(size.height * 0.6), size);
await page.waitForFunction(() => document.querySelector('#walk').dataset.pixel, { timeout: 10000 });
await page.evaluate(() => window.scrollTo(0, 0));
const bottom = await page.$eval('#effort', node => node.getBoundingClientRect().top);
await page.screenshot({ path: out, type: 'jpeg', quality: 80, clip: { x: 0, y: 0, width: 1500, height: Math.floor(bottom) } });
await browser.close();
