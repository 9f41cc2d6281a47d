// node validate.mjs ALEPH FILE...: Khronos' glTF-Validator and `aleph explain` must agree on which files are valid.
// Ends with 1 where they do not.
import { spawnSync } from 'node:child_process';
import { createRequire } from 'node:module';
import fs from 'node:fs';
import path from 'node:path';

// The package stands in the folder that this is run in (npm ci), not beside this file.
const require = createRequire(path.join(process.cwd(), 'package.json'));
const validator = require('gltf-validator');

// Files that the validator rejects and we load with a warning, and the one error that it may find in each.
const loadedWithAWarning = {
  'Cameras.gltf': 'ROTATION_NON_UNIT',
  'box_sparse.glb': 'UNSATISFIED_DEPENDENCY',
};

const [aleph, ...files] = process.argv.slice(2);
let disagreements = 0;
for (const file of files) {
  const folder = path.dirname(file);
  const load = uri => fs.promises.readFile(path.join(folder, decodeURIComponent(uri))).then(b => new Uint8Array(b));
  let errors;
  try {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
      uri: path.basename(file),
      externalResourceFunction: load,
      maxIssues: 0,
    });
    errors = report.issues.messages.filter(message => message.severity === 0);
  } catch (error) { // not even JSON, or no container
    errors = [{ code: String(error), pointer: '' }];
  }

  // test_gltf_round_trip has loaded what it wrote.
  const isOwn = path.basename(folder) === 'round_trip';
  const excused = loadedWithAWarning[path.basename(file)];
  // A fingerprint is of what was loaded, and needs no effects plan; only --json has the warnings.
  const words = ['explain', file, excused ? '--json' : '--fingerprint'];
  const ours = isOwn ? { status: 0 } : spawnSync(aleph, words, { encoding: 'utf8', maxBuffer: 1 << 28 });
  const loads = ours.status === 0;
  const codes = [...new Set(errors.map(error => error.code))];
  let verdict = errors.length === 0 === loads ? 'agreed' : 'DISAGREED';
  if (excused && loads && codes.length === 1 && codes[0] === excused) {
    const warned = JSON.parse(ours.stdout).warnings?.length > 0;
    verdict = warned ? 'agreed (loads with a warning)' : 'DISAGREED: no warning';
  }
  if (ours.status !== 0 && ours.status !== 2) verdict = `DISAGREED: aleph ended with ${ours.status ?? ours.signal}`;
  if (verdict.startsWith('DISAGREED')) disagreements++;
  const theirs = errors.length === 0 ? 'valid' : `${errors.length} errors: ${codes.slice(0, 3).join(', ')}`;
  console.log(`${verdict}: ${file}: validator: ${theirs}; aleph: ${loads ? 'loads' : 'refuses'}`);
  if (verdict.startsWith('DISAGREED')) {
    console.log(`    ${errors.slice(0, 3).map(e => `${e.code} ${e.pointer}`).join('; ')}`);
    if (!isOwn) console.log(`    ${ours.stderr.trim().split('\n').slice(-1)[0]}`);
  }
}
console.log(`${files.length} files, ${disagreements} disagreements`);
process.exit(disagreements === 0 ? 0 : 1);
