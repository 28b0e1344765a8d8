import type { Overview } from '@/store/recording/types';
import { shownTrail } from '@/store/session/trace/shownTrail';

const NOTHING = new Float32Array();

let pathOf: Overview | null = null;

/**
 * Shows the trail until a moment. It is read again when more of the recording was read.
 *
 * @param isPresent whether the page's own trail is of this run: it is shown until the recorded one is there.
 */
export async function showTrail(
  t: number,
  overview: Overview | null,
  isPresent: boolean,
  read: () => Promise<Float32Array | null>,
): Promise<void> {
  shownTrail.show(t, shownTrail.points ?? (isPresent ? null : NOTHING));
  if (overview === null || overview === pathOf) return;
  pathOf = overview;
  const points = await read();
  if (pathOf === overview && points !== null && shownTrail.until !== null)
    shownTrail.show(shownTrail.until, points);
}

/** Shows the trail of the present, or of another run from now on. */
export function showPresentTrail(): void {
  pathOf = null;
  shownTrail.show(null, null);
}
