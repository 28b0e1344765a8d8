import { afterAll, vi } from 'vitest';

/*
 * Removes what a file of tests leaves behind in its process, for files without components. A timer that fires
 * after the last file would find no document, and a store keeps what the file before wrote: modules of ours are
 * evaluated again for each file.
 */
const timers: ReturnType<typeof setTimeout>[] = [];
const { setTimeout } = globalThis;

globalThis.setTimeout = Object.assign((...args: Parameters<typeof setTimeout>) => {
  const timer = setTimeout(...args);
  timers.push(timer);
  return timer;
}, setTimeout);

afterAll(() => {
  for (const timer of timers) clearTimeout(timer);
  globalThis.setTimeout = setTimeout;
  globalThis.localStorage?.clear();
  globalThis.sessionStorage?.clear();
  vi.resetModules();
});
