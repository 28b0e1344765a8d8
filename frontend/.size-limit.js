import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import process from 'node:process';

// What a page makes the browser load is its entry with all that this imports at once: chunks that are
// only imported lazily do not count. So a new import in the wrong place is noticed, wherever it lands.
const dist = process.env.BT_STUDIO_DIST ?? 'dist';
const assets = join(dist, 'assets');

/** The chunks that a chunk needs before it runs, itself among them. */
function closure(start) {
  const found = new Set();
  const waiting = [...start];
  while (waiting.length > 0) {
    const name = waiting.pop();
    if (found.has(name)) continue;
    found.add(name);
    const text = readFileSync(join(assets, name), 'utf-8');
    for (const [, imported] of text.matchAll(/(?:\bfrom|\bimport)\s*["']\.\/([\w.-]+\.js)["']/g)) {
      waiting.push(imported);
    }
  }
  return [...found];
}

const page = readFileSync(join(dist, 'index.html'), 'utf-8');
const entry = [...page.matchAll(/(?:src|href)="[^"]*assets\/([\w.-]+\.js)"/g)].map(([, name]) => name);
const studio = readdirSync(assets).filter((name) => /^Studio-.*\.js$/.test(name));
const paths = (names) => names.map((name) => join(assets, name));

export default [
  { name: 'first page', path: paths(closure(entry)), limit: '270 kB', gzip: true },
  {
    name: 'editor, with the first page, without 3D and code editor',
    path: paths(closure([...entry, ...studio])),
    limit: '900 kB',
    gzip: true,
  },
];
