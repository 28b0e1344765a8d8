import { IconBellOff, IconMessage2, IconScript } from '@tabler/icons-react';
import type { DiagramNode } from '@/model/diagram';
import classes from './Block.module.css';

/** Small signs for a block's conditions, scripts, comment and silenced findings. */
export function BlockBadges({ node }: { readonly node: DiagramNode }) {
  const conditions = Object.entries(node.conditions ?? {});
  const silenced = Object.entries(node.silenced ?? {});
  if (conditions.length === 0 && silenced.length === 0 && !node.comment) return null;
  return (
    <span className={classes['badges']}>
      {conditions.length > 0 && (
        <span title={conditions.map(([key, text]) => `${key}: ${text}`).join('\n')}>
          <IconScript size={14} stroke={1.8} aria-hidden="true" />
        </span>
      )}
      {node.comment && (
        <span title={node.comment}>
          <IconMessage2 size={14} stroke={1.8} aria-hidden="true" />
        </span>
      )}
      {silenced.length > 0 && (
        <span
          title={silenced.map(([code, reason]) => `${code}: ${reason}`).join('\n')}
          data-testid="silenced"
        >
          <IconBellOff size={14} stroke={1.8} aria-hidden="true" />
        </span>
      )}
    </span>
  );
}
