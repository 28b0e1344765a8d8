import type { Revision } from '@/api/revisions';

/** Consecutive saves with the same author and message and without a long break, the newest first. */
export interface RevisionGroup {
  readonly newest: Revision;
  readonly saves: readonly Revision[];
}

const SITTING_MS = 10 * 60_000;

function continues(later: Revision, earlier: Revision): boolean {
  const pause = Date.parse(later.created_at) - Date.parse(earlier.created_at);
  return (
    later.author === earlier.author &&
    later.message === earlier.message &&
    earlier.label === '' &&
    pause <= SITTING_MS
  );
}

/** Groups the many revisions of autosaving. A labelled revision begins a group, so that it is visible. */
export function groupRevisions(revisions: readonly Revision[]): RevisionGroup[] {
  const groups: Revision[][] = [];
  for (const revision of revisions) {
    const last = groups.at(-1);
    const later = last?.at(-1);
    if (last && later && continues(later, revision)) last.push(revision);
    else groups.push([revision]);
  }
  return groups.flatMap((saves) => {
    const [newest] = saves;
    return newest ? [{ newest, saves }] : [];
  });
}
