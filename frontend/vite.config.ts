import react from '@vitejs/plugin-react';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';
import { bounds } from './bounds.ts';
import { compressed } from './compressed.ts';
import { fontNotices, NOTICES } from './notices.ts';
import { validators } from './validators.ts';

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const backend = process.env.BT_STUDIO_BACKEND ?? 'http://127.0.0.1:8000';

/** Tests that need no page; those named here do. */
const PLAIN = [
  'src/model/**/!(copied|xml).test.ts',
  'src/store/recording/**/!(liveSource|recording.worker|storedSource).test.ts',
  'src/store/session/**/!(live|liveFeed|shown|traceFeed).test.ts',
];

export default defineConfig({
  plugins: [react(), validators(), fontNotices(), bounds(), compressed()],
  resolve: {
    alias: { '@': here('./src'), '@catalog': here('../tree_gardener/catalog.json') },
  },
  server: {
    host: '127.0.0.1',
    proxy: {
      '/api': { target: backend },
      '/ws': { target: backend, ws: true },
    },
    // The catalogue of nodes lives beside the engine, one folder up.
    fs: { allow: [here('..')] },
  },
  build: {
    outDir: 'dist',
    target: 'es2022',
    // The content security policy allows neither inline scripts nor data: scripts.
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    sourcemap: false,
    // Licences ask that their text goes along with what is made of them.
    license: { fileName: NOTICES },
  },
  test: {
    projects: [
      {
        extends: true,
        test: {
          name: 'plain',
          environment: 'node',
          include: PLAIN,
          setupFiles: ['./harness/everything.ts', './harness/ownState.ts'],
        },
      },
      {
        extends: true,
        test: {
          name: 'modules',
          environment: 'jsdom',
          include: ['src/**/*.test.ts'],
          exclude: PLAIN,
          setupFiles: ['./vitest.setup.ts', './harness/everything.ts', './harness/ownState.ts'],
        },
      },
      {
        extends: true,
        test: {
          name: 'components',
          environment: 'jsdom',
          include: ['{src,harness}/**/*.test.tsx'],
          // Removes what a file leaves behind in the page, its stores and its modules.
          setupFiles: ['./vitest.setup.ts', './harness/everything.ts', './harness/sharedPage.ts'],
        },
      },
    ],
    // Files share a process with the libraries that it has loaded, which takes most of the time of a process of
    // their own.
    isolate: false,
    // Styles are left out, but for the colours that pictures are drawn with.
    css: { include: [/tokens\.css\?raw$/] },
    // A busy machine is slow, and nothing is asserted about time.
    expect: { poll: { timeout: 20_000 } },
    maxWorkers: 2,
    // Property tests on a busy machine: long, and never endless.
    testTimeout: 60_000,
    restoreMocks: true,
    // The build for Node loads a second three.js, whose objects are none of ours.
    alias: [
      {
        find: /^@react-three\/fiber$/,
        replacement: here('./node_modules/@react-three/fiber/dist/react-three-fiber.esm.js'),
      },
    ],
    server: { deps: { inline: [/@react-three\//] } },
  },
});
