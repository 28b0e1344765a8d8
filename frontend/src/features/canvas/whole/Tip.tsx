import { useTranslation } from 'react-i18next';
import { displayName } from '@/model/diagram';
import type { Part, Room } from '@/model/nested';
import { useShownLive } from '@/store/moment/store';
import { pastOf } from '@/store/project/live';
import type { Facts } from './facts';
import { boxOf } from './frame';
import classes from './WholeTree.module.css';

interface Props {
  readonly fact: Facts;
  readonly parts: readonly Part[];
  readonly room: Room;
}

const BESIDE = 6;

/** Names the block that the pointer is on, most of which have no name in the picture. */
export function Tip({ fact, parts, room }: Props) {
  const { t } = useTranslation('canvas');
  const { id, key, node } = fact;
  const status = useShownLive((state) => state.statuses.get(key) ?? 'IDLE');
  const past = useShownLive((state) => pastOf(state, key));
  const box = boxOf(parts, id);
  if (!box) return null;
  const name = displayName(node);
  const words = [
    ...(node.type === name ? [] : [node.type]),
    ...(status === 'IDLE' ? [] : [t(`status.${status}`)]),
    ...(past === undefined ? [] : [t('announce.past', { status: t(`status.${past}`) })]),
  ];
  // On the side where there is more room.
  const isRight = box.x > room.width / 2;
  const isBelow = box.y > room.height / 2;
  return (
    <div
      className={classes['tip']}
      aria-hidden="true"
      style={{
        ...(isRight ? { right: room.width - box.x - box.width } : { left: box.x }),
        ...(isBelow ? { bottom: room.height - box.y + BESIDE } : { top: box.y + box.height + BESIDE }),
      }}
    >
      <b>{name}</b>
      {words.length > 0 && <span>{words.join(' · ')}</span>}
    </div>
  );
}
