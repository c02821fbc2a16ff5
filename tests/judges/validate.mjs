// Khronos' validator on files: says what is wrong, and how many files were sound.
import { readFileSync, existsSync } from 'node:fs';
import { dirname, join } from 'node:path';
import validator from 'gltf-validator';

let bad = 0;
const files = process.argv.slice(2);
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: file,
    maxIssues: 20,
    severityOverrides: {},
    externalResourceFunction: async (uri) => {
      const path = join(dirname(file), decodeURIComponent(uri));
      if (!existsSync(path)) throw new Error(`no file ${path}`);
      return new Uint8Array(readFileSync(path));
    },
  });
  for (const issue of report.issues.messages)
    if (issue.severity === 0) console.log(`${file}: ${issue.pointer ?? ''}: ${issue.code}: ${issue.message}`);
  if (report.issues.numErrors > 0) bad += 1;
}
console.log(`${files.length - bad} of ${files.length} files are sound`);
process.exit(bad > 0 ? 1 : 0);
