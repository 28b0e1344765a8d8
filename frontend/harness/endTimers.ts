import { afterAll } from 'vitest';

/*
 * Ends what a file of tests leaves waiting: a timer that fires after the last file would find no document.
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
});
