import { useTranslation } from 'react-i18next';
import { displayName, type Diagram, type NodeId } from '@/model/diagram';
import { useMoment, useShownLive } from '@/store/moment/store';
import { liveKey, pastOf } from '@/store/project/live';
import classes from './recorded.module.css';

interface Props {
  readonly diagram: Diagram;
  readonly id: NodeId;
}

/** The selected block of the tree as it ran: its status, and what its ports were given. */
export function Details({ diagram, id }: Props) {
  const { t } = useTranslation(['axis', 'run']);
  const key = liveKey(diagram.id, id);
  const status = useShownLive((state) => state.statuses.get(key) ?? 'IDLE');
  const past = useShownLive((state) => pastOf(state, key));
  const ran = useMoment(({ tree }) =>
    tree.find((each) => each.tree_id === diagram.id && each.node_id === id),
  );
  const node = diagram.nodes[id];
  if (!node) return null;
  const ports = Object.entries(ran?.ports ?? node.ports ?? {});
  const name = displayName(node);
  return (
    <footer className={classes['details']} aria-label={t('past.block', { name })} data-testid="past-details">
      <b>{name}</b>
      {name === node.type ? null : <span className={classes['type']}>{node.type}</span>}
      <span data-status={past ?? status}>{ran ? t(`run:status.${past ?? status}`) : t('past.notRun')}</span>
      {ports.map(([port, value]) => (
        <span key={port} className={classes['port']}>
          {port} = <code>{value}</code>
        </span>
      ))}
    </footer>
  );
}
