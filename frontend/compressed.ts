import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';

/** Kinds of files that shrink; pictures and fonts are compressed already. */
const SHRINKS = /\.(js|css|html|svg|json|md|txt|wasm)$/;
/** Smaller files fit into one packet as they are. */
const WORTH_BYTES = 1024;

/**
 * Writes a brotli and a gzip file beside each file that gets smaller by it: once, at the build, and as small as
 * can be, since the server only hands them out.
 */
export function compressFiles(folder: string): void {
  for (const entry of readdirSync(folder, { recursive: true, withFileTypes: true })) {
    if (!entry.isFile() || !SHRINKS.test(entry.name)) continue;
    const path = join(entry.parentPath, entry.name);
    const content = readFileSync(path);
    if (content.length < WORTH_BYTES) continue;
    const params = { [constants.BROTLI_PARAM_SIZE_HINT]: content.length };
    writeFileSync(`${path}.br`, brotliCompressSync(content, { params }));
    writeFileSync(`${path}.gz`, gzipSync(content, { level: 9 }));
  }
}

/** Compresses the whole build, after every other plug-in has written its files. */
export function compressed(): Plugin {
  let folder = 'dist';
  return {
    name: 'bt-studio-compressed',
    apply: 'build',
    enforce: 'post',
    configResolved(config) {
      folder = config.build.outDir;
    },
    closeBundle: { order: 'post', handler: () => compressFiles(folder) },
  };
}
