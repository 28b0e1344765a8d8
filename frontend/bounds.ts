import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';

/** The most KB (1024 bytes) of files of the build, packed by gzip. */
const BOUNDS = [{ file: /^recording\.worker-[^/]*\.js$/, kilobytes: 40 }];

/** Returns what exceeds its bound or is missing, of files by name. */
function beyondBounds(files: ReadonlyMap<string, Uint8Array>): string[] {
  return BOUNDS.flatMap(({ file, kilobytes }) => {
    const found = [...files].filter(([name]) => file.test(name));
    if (found.length === 0) return [`No file of the build matches ${String(file)}.`];
    return found.flatMap(([name, content]) => {
      const size = gzipSync(content, { level: 9 }).length / 1024;
      return size > kilobytes
        ? [`${name} has ${size.toFixed(1)} KB packed; at most ${String(kilobytes)} are allowed.`]
        : [];
    });
  });
}

/** Fails the build if a file that pages load early for a feature has become too large. */
export function bounds(): Plugin {
  return {
    name: 'bt-studio-bounds',
    apply: 'build',
    writeBundle({ dir = 'dist' }) {
      const folder = join(dir, 'assets');
      const files = readdirSync(folder).filter((name) => BOUNDS.some(({ file }) => file.test(name)));
      const found = new Map(files.map((name) => [name, readFileSync(join(folder, name))]));
      for (const problem of beyondBounds(found)) this.error(problem);
    },
  };
}
