import { extent } from '@/store/moment/looking';
import { useSource } from '@/store/moment/source';

/** Returns the run of the session at which the user looks, else the last one; undefined without a recording. */
export function runToKeep(runs: readonly string[]): string | undefined {
  const shown = useSource.getState().kept ? undefined : extent()?.run;
  return runs.find((run) => run === shown) ?? runs.at(-1);
}
