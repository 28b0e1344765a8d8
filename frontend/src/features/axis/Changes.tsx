import { ActionIcon } from '@mantine/core';
import { IconX } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { changesBetween, lookAt } from '@/store/moment/looking';
import { useRange } from '@/store/moment/range';
import { useMoment } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import type { Changes as Found } from '@/store/recording/types';
import { frames } from '@/store/session/frames';
import { showPanel } from '@/workspace/tabs';
import classes from './axis.module.css';
import { movedBodies, shortValue } from './changes';

interface ChangesProps {
  readonly end: number;
  /** Reads the changes between two moments. */
  readonly between?: typeof changesBetween;
}

/** What changed from moment A to moment B, or to the shown one: each line leads to its block, key or body. */
export function Changes({ end, between = changesBetween }: ChangesProps) {
  const { t } = useTranslation('axis');
  const a = useRange((state) => state.a);
  const b = useRange((state) => state.b);
  const isComparing = useRange((state) => state.isComparing);
  const moment = useMoment((state) => state.t);
  const overview = useMoment((state) => state.overview);
  const nodes = useMoment((state) => state.tree);
  const [found, setFound] = useState<Found | null>(null);
  const to = b ?? moment ?? end;
  const isShown = isComparing && a !== null;
  useEffect(() => {
    if (!isShown) return;
    let isCurrent = true;
    void between(a, to).then((changes) => isCurrent && setFound(changes));
    return () => {
      isCurrent = false;
    };
    // The overview changes when more of the recording was read.
  }, [isShown, a, to, overview, between]);
  if (!isShown) return null;
  const moved = found ? movedBodies(found.poses, frames.scene()) : [];
  const count = found ? found.statuses.length + found.entries.length + moved.length : 0;
  const close = () => useRange.setState({ isComparing: false });
  return (
    <section className={classes['changes']} aria-label={t('changes.label')} data-testid="axis-changes">
      <header className={classes['changesHead']}>
        <strong>{t('changes.title', { a: a.toFixed(2), b: to.toFixed(2) })}</strong>
        <ActionIcon size="sm" aria-label={t('changes.close')} onClick={close}>
          <IconX size={14} />
        </ActionIcon>
      </header>
      {found === null ? (
        <p className={classes['changesNote']}>{t('changes.unread')}</p>
      ) : count === 0 ? (
        <p className={classes['changesNote']}>{t('changes.none')}</p>
      ) : (
        <ul className={classes['changesList']}>
          {found.statuses.map(({ uid, path, from, to: now }) => (
            <Line
              key={`s${uid}`}
              kind="status"
              go={() => {
                const node = nodes.find((each) => each.uid === uid);
                if (node?.node_id) useProjectStore.getState().reveal(node.tree_id, node.node_id);
              }}
            >
              {t('changes.status', { name: path, from, to: now })}
            </Line>
          ))}
          {found.entries.map(({ scope, key, from, to: now, since }) => (
            <Line
              key={`k${scope}/${key}`}
              kind="key"
              go={() => {
                showPanel('blackboard');
                if (since !== null) lookAt(since);
              }}
            >
              {t('changes.key', {
                name: scope ? `${scope}/${key}` : key,
                from: shortValue(from),
                to: shortValue(now),
              })}
            </Line>
          ))}
          {moved.map(({ id, name, metres, degrees }) => (
            <Line key={`p${id}`} kind="pose" go={() => showPanel('viewer3d')}>
              {t('changes.pose', { name, metres: metres.toFixed(3), degrees: degrees.toFixed(0) })}
            </Line>
          ))}
        </ul>
      )}
    </section>
  );
}

interface LineProps {
  readonly kind: 'status' | 'key' | 'pose';
  readonly go: () => void;
  readonly children: string;
}

function Line({ kind, go, children }: LineProps) {
  return (
    <li>
      <button
        type="button"
        className={classes['change']}
        data-testid="axis-change"
        data-kind={kind}
        onClick={go}
      >
        {children}
      </button>
    </li>
  );
}
