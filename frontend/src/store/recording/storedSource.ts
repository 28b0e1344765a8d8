import { runs, type StoredRun } from '@/api/runs';
import type { Segment } from '@/generated/messages';
import type { RecordingSource } from './types';

/** Each part costs a request and a new overview; the server answers up to 8 MiB. */
const PART_BYTES = 4 << 20;

/** The recording of a run that was kept with a project: one segment, read in ranges. */
export function storedSource(projectId: string, run: StoredRun): RecordingSource {
  const segment: Segment = {
    run: run.id.replaceAll('-', ''),
    branch: 0,
    number: 0,
    version: 0,
    from_t: run.start_s,
    to_t: run.start_s + run.length_s,
    bytes: run.size,
    complete: true,
    run_number: 1,
    result: null,
  };
  return {
    segments: () => [segment],
    partBytes: PART_BYTES,
    isOneFile: true,
    subscribe: () => () => undefined,
    read: async (_, offset, length) => {
      const range = `bytes=${offset}-${offset + length - 1}`;
      const answer = await fetch(runs.recordingUrl(projectId, run.id), { headers: { Range: range } });
      if (answer.status !== 206) throw new Error(`The recording cannot be read (${answer.status}).`);
      return new Uint8Array(await answer.arrayBuffer());
    },
  };
}
