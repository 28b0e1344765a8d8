import react from '@vitejs/plugin-react';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { validators } from '../validators.ts';

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** The editor alone on a fixture, without a server: for work on the canvas and for its pictures. */
export default defineConfig({
  root: here('.'),
  plugins: [react(), validators()],
  resolve: { alias: { '@': here('../src'), '@catalog': here('../../tree_gardener/catalog.json') } },
  server: { host: '127.0.0.1', fs: { allow: [here('../..')] } },
  css: { postcss: here('..') },
  build: { outDir: here('../node_modules/.cache/harness'), emptyOutDir: true },
});
