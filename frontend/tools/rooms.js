/**
 * Checks the folders of `src` for two things that ESLint does not see: cycles of imports between modules or
 * features, and folders of more than twenty modules without a reason.
 */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import process from 'node:process';
import ts from 'typescript';

const ROOT = 'src';
const MOST = 20;

/** The folders that may have more modules, each with its reason. */
const LARGE = {
  'src/model': 'each module is one pure part of the tree (rules, layout, ports, undo …), read by its name',
  'src/features/inspector': 'each module is one field or section of the inspector, read by its name',
};

const isModule = (name) => /\.tsx?$/.test(name) && !/\.test\.tsx?$/.test(name);

const modules = readdirSync(ROOT, { recursive: true, encoding: 'utf8' })
  .map((name) => join(ROOT, name))
  .filter(isModule);

function resolve(from, specifier) {
  const base = specifier.startsWith('@/')
    ? join(ROOT, specifier.slice(2))
    : specifier.startsWith('.')
      ? normalize(join(dirname(from), specifier))
      : null;
  if (base === null) return null;
  const candidates = [base, `${base}.ts`, `${base}.tsx`, join(base, 'index.ts')];
  return candidates.find((path) => isModule(path) && existsSync(path)) ?? null;
}

const importsOf = (path) =>
  ts
    .preProcessFile(readFileSync(path, 'utf8'), true, true)
    .importedFiles.map(({ fileName }) => resolve(path, fileName))
    .filter((found) => found !== null && found !== path);

/** Returns the folder that a module counts for: its feature, or its folder of `src`. */
function roomOf(path) {
  const parts = path.split('/');
  return parts.slice(0, parts[1] === 'features' ? 3 : 2).join('/');
}

/**
 * Returns the members of the first cycle of a graph, or null. The search is depth-first; a node met twice
 * closes a cycle.
 */
function cycleOf(graph) {
  const done = new Set();
  const trail = [];
  const visit = (name) => {
    const met = trail.indexOf(name);
    if (met >= 0) return [...trail.slice(met), name];
    if (done.has(name)) return null;
    trail.push(name);
    for (const next of graph.get(name) ?? []) {
      const found = visit(next);
      if (found) return found;
    }
    trail.pop();
    done.add(name);
    return null;
  };
  for (const name of graph.keys()) {
    const found = visit(name);
    if (found) return found;
  }
  return null;
}

const files = new Map(modules.map((path) => [path, importsOf(path)]));
const rooms = new Map();
for (const [path, imports] of files) {
  const room = roomOf(path);
  const others = imports.map(roomOf).filter((other) => other !== room);
  rooms.set(room, new Set([...(rooms.get(room) ?? []), ...others]));
}

const sizes = new Map();
for (const path of modules) sizes.set(dirname(path), (sizes.get(dirname(path)) ?? 0) + 1);

const faults = [];
for (const [name, graph] of Object.entries({ modules: files, rooms })) {
  const cycle = cycleOf(graph);
  if (cycle) faults.push(`A cycle of ${name}: ${cycle.join(' → ')}`);
}
for (const [folder, size] of sizes) {
  if (size > MOST && !(folder in LARGE)) {
    faults.push(`${folder} holds ${size} modules: divide it, or give the reason in tools/rooms.js.`);
  }
}
for (const folder of Object.keys(LARGE)) {
  if ((sizes.get(folder) ?? 0) <= MOST) faults.push(`${folder} needs no reason any longer: tools/rooms.js.`);
}
for (const fault of faults) process.stderr.write(`${fault}\n`);
process.exitCode = faults.length === 0 ? 0 : 1;
