import type { Mark } from '@/store/recording/types';
import { lookAt } from './looking';
import { selectPast } from './pastTree';
import { useMoment } from './store';

/** Goes to the moment of a mark, and selects the block that it is about in the tree as it ran. */
export function lookAtMark({ t, tick, uid }: Mark): void {
  lookAt(t, tick ?? null);
  if (uid === undefined) return;
  const wanted = useMoment.getState().t;
  const select = (): boolean => {
    const { t: now, shown, tree } = useMoment.getState();
    if (now !== wanted) return true;
    if (shown?.t !== wanted) return false;
    const node = tree.find((each) => each.uid === uid);
    if (node?.node_id) selectPast(node.tree_id, node.node_id);
    return true;
  };
  if (wanted === null || select()) return;
  const stop = useMoment.subscribe(() => {
    if (select()) stop();
  });
}
