// Numbers and settings as text.

/** A number with a few significant digits. @param {number|null|undefined} value @param {number} [digits] */
export function number(value, digits = 4) {
  if (value === null || value === undefined) return '–';
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'not a number' : value > 0 ? '∞' : '−∞';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) return value.toExponential(digits - 1).replace('-', '−').replace('e+', 'e');
  const text = Number.isInteger(value) && size >= 1000 ? value.toLocaleString('en') : String(Number(value.toPrecision(digits)));
  return text.replace('-', '−');
}

/** A metric with its standard error. @param {{value: number, error?: number}|null|undefined} metric */
export function withError(metric) {
  if (!metric || metric.value === null) return '–';
  return metric.error ? `${number(metric.value)} ± ${number(metric.error, 2)}` : number(metric.value);
}

/** A setting's value as text. @param {any} value */
export function settingText(value) {
  if (value === undefined) return '–';
  return typeof value === 'object' && value !== null ? JSON.stringify(value) : String(value);
}

/** Title with unit. @param {{title: string, unit?: string}} quantity */
export function withUnit(quantity) {
  return quantity.unit ? `${quantity.title} (${quantity.unit})` : quantity.title;
}
