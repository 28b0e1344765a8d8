import type { Segment } from '@/generated/messages';
import { send } from '@/store/session/connection';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';
import type { RecordingSource } from './types';

/** The time in ms after which a part counts as lost: its frame went with a socket. */
const LOST_AFTER_MS = 15_000;

/** The recording of the last run of the page's session. */
export const liveSource: RecordingSource = {
  segments: () => {
    const { segments } = useSessionStore.getState();
    const run = segments.at(-1)?.run;
    return segments.filter((segment) => segment.run === run);
  },
  subscribe: (changed) =>
    useSessionStore.subscribe((now, before) => {
      if (now.segments !== before.segments) changed();
    }),
  read: ({ run, branch, number: segment, version }, offset, length) =>
    new Promise((resolve, reject) => {
      const timer = setTimeout(() => end(() => reject(new Error('The part did not arrive.'))), LOST_AFTER_MS);
      const stop = frames.listen('recording', (part) => {
        const isIt = part.run === run && part.branch === branch && part.segment === segment;
        if (isIt && part.version === version && part.offset === offset) end(() => resolve(part.data));
      });
      const end = (doIt: () => void) => {
        clearTimeout(timer);
        stop();
        doIt();
      };
      send('read_recording', { run, branch, segment, version, offset, length }).catch((error: Error) =>
        end(() => reject(error)),
      );
    }),
};

/** Returns the runs whose recordings can be read, the last one at the end. */
export const runsOf = (segments: readonly Segment[]): string[] => [
  ...new Set(segments.map(({ run }) => run)),
];

/** Returns the recording of an earlier run of the page's session. */
export const earlierSource = (run: string): RecordingSource => ({
  segments: () => useSessionStore.getState().segments.filter((segment) => segment.run === run),
  subscribe: (changed) => liveSource.subscribe(changed),
  read: (segment, offset, length) => liveSource.read(segment, offset, length),
});
