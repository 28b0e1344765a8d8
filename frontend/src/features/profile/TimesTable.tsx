import { ActionIcon } from '@mantine/core';
import { IconMicroscope } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { NodeTime, TreeNode } from '@/generated/messages';
import { shareOf, slowest } from '@/model/profile';
import { sample } from '@/store/debug/profile';
import { useProjectStore } from '@/store/project';
import { openTree } from '@/store/project/navigation';
import classes from './profile.module.css';

const MOST_ROWS = 50;
const IS_LEAF: readonly string[] = ['Action', 'Condition'];

interface TimesTableProps {
  readonly tree: readonly TreeNode[];
  readonly times: readonly NodeTime[];
  readonly wholeMs: number;
  readonly canSample: boolean;
}

/** The nodes with most time of their own; each name leads to its block. */
export function TimesTable({ tree, times, wholeMs, canSample }: TimesTableProps) {
  const { t } = useTranslation('profile');
  const rows = slowest(times);
  const reveal = ({ tree_id, node_id }: TreeNode) => {
    openTree(tree_id);
    useProjectStore.getState().reveal(tree_id, node_id);
  };
  return (
    <table className={classes['times']} aria-label={t('times')}>
      <thead>
        <tr>
          <th scope="col">{t('column.node')}</th>
          <th scope="col">{t('column.share')}</th>
          <th scope="col">{t('column.self')}</th>
          <th scope="col">{t('column.total')}</th>
          <th scope="col">{t('column.calls')}</th>
        </tr>
      </thead>
      <tbody>
        {rows.slice(0, MOST_ROWS).map((time) => {
          const node = tree[time.uid - 1];
          if (!node) return null;
          return (
            <tr key={time.uid}>
              <th scope="row">
                <button
                  type="button"
                  className={classes['place']}
                  title={node.path}
                  onClick={() => reveal(node)}
                >
                  {node.name}
                </button>
                {canSample && IS_LEAF.includes(node.kind) && (
                  <ActionIcon
                    size={24}
                    aria-label={t('sample', { name: node.name })}
                    title={t('sample', { name: node.name })}
                    onClick={() => void sample(node)}
                  >
                    <IconMicroscope size={15} />
                  </ActionIcon>
                )}
              </th>
              <td>{(shareOf(time, wholeMs) * 100).toFixed(1)} %</td>
              <td>{((time.self_ms / Math.max(1, time.calls)) * 1000).toFixed(1)}</td>
              <td>{((time.total_ms / Math.max(1, time.calls)) * 1000).toFixed(1)}</td>
              <td>{time.calls}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}
