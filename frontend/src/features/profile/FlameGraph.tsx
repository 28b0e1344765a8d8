import { useTranslation } from 'react-i18next';
import type { NodeTime, TreeNode } from '@/generated/messages';
import { flames } from '@/model/profile';
import classes from './profile.module.css';

const ROW_PX = 20;

interface FlameGraphProps {
  readonly tree: readonly TreeNode[];
  readonly times: readonly NodeTime[];
}

/** The nodes below each other, each as wide as its time; the table beside it says the same in numbers. */
export function FlameGraph({ tree, times }: FlameGraphProps) {
  const { t } = useTranslation('profile');
  const found = flames(tree, times);
  const depth = Math.max(0, ...found.map((each) => each.depth + 1));
  return (
    <div
      className={classes['flames']}
      style={{ height: depth * ROW_PX }}
      role="img"
      aria-label={t('flames')}
      data-testid="flames"
    >
      {found.map(({ node, time, from, width, depth: row }) => (
        <span
          key={node.uid}
          className={classes['flame']}
          data-kind={node.kind}
          title={t('flame', {
            name: node.path,
            total: time.total_ms.toFixed(2),
            self: time.self_ms.toFixed(2),
            count: time.calls,
          })}
          style={{ left: `${from * 100}%`, width: `${width * 100}%`, top: row * ROW_PX }}
        >
          {node.name}
        </span>
      ))}
    </div>
  );
}
