import { appendFileSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

export const NOTICES = 'third-party-notices.md';
const FONTS = ['@fontsource-variable/inter', '@fontsource-variable/jetbrains-mono'];

/** Adds the licences of the fonts to Vite's list, which has those of scripts only. */
export function fontNotices(): Plugin {
  return {
    name: 'bt-studio-font-notices',
    apply: 'build',
    writeBundle({ dir }) {
      for (const name of FONTS) {
        const folder = fileURLToPath(new URL(`./node_modules/${name}/`, import.meta.url));
        const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as {
          version: string;
          license: string;
        };
        const text = readFileSync(join(folder, 'LICENSE'), 'utf8');
        appendFileSync(join(dir ?? 'dist', NOTICES), `\n## ${name} - ${version} (${license})\n\n${text}\n`);
      }
    },
  };
}
