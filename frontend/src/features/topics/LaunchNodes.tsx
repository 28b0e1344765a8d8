import { Button, Tooltip } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { IconCircleCheck, IconCircleX, IconPlayerPlayFilled, IconRefresh } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import type { LaunchNode } from '@/generated/messages';
import { useConsoleFilter } from '@/features/console/filter';
import { showPanel } from '@/workspace/tabs';
import { openFile } from '@/store/project/navigation';
import { useIsBack } from '@/store/moment/store';
import { restartNode } from '@/store/run/topics';
import { useSessionStore } from '@/store/session/store';
import classes from './topics.module.css';

const ICONS = { running: IconPlayerPlayFilled, ended: IconCircleCheck, failed: IconCircleX };

/** The list of processes of the project's launch files: state, last output, and restart. */
export function LaunchNodes({ nodes }: { readonly nodes: readonly LaunchNode[] }) {
  const { t } = useTranslation('topics');
  if (nodes.length === 0) return <p className={classes['empty']}>{t('noNodes')}</p>;
  return (
    <ul className={classes['nodes']}>
      {nodes.map((node) => (
        <NodeRow key={node.id} node={node} />
      ))}
    </ul>
  );
}

/** Shows the output of a node in the console. */
function showLog({ id }: LaunchNode): void {
  useConsoleFilter.setState({ source: `launch:${id}`, level: 'debug', search: '' });
  showPanel('console');
}

function NodeRow({ node }: { readonly node: LaunchNode }) {
  const { t } = useTranslation('topics');
  const canRestart = useSessionStore(
    ({ executor, introspection }) =>
      (executor === 'application_running' || executor === 'paused') && introspection?.role !== 'viewer',
  );
  const isBack = useIsBack();
  const lastLine = useSessionStore(
    ({ logs }) => logs.findLast((line) => line.launch_node === node.id)?.text ?? '',
  );
  const Icon = ICONS[node.state];
  const restart = () =>
    restartNode(node.id).catch((error: Error) =>
      notifications.show({ color: 'red', title: t('refused'), message: reasonOf(error) }),
    );
  return (
    <li className={classes['node']} data-testid={`launch-${node.name}`} data-state={node.state}>
      <span className={classes['nodeState']} data-state={node.state}>
        <Icon size={15} aria-hidden="true" />
        {t(`state.${node.state}`)}
      </span>
      <span className={classes['nodeText']}>
        <strong>{node.name}</strong>{' '}
        <span className={classes['muted']}>
          {[node.package, node.executable].filter(Boolean).join(' / ')}
          {node.restarts > 0 ? ` · ${t('restarts', { count: node.restarts })}` : ''}
        </span>
        <span className={classes['nodeEnd']}>{node.end || lastLine}</span>
      </span>
      <Button size="compact-xs" variant="subtle" onClick={() => showLog(node)}>
        {t('log')}
      </Button>
      <Button size="compact-xs" variant="subtle" onClick={() => openFile(node.file, node.line)}>
        {node.file.split('/').at(-1)}:{node.line}
      </Button>
      <Tooltip label={t('restartHelp')}>
        <Button
          size="compact-xs"
          variant="default"
          leftSection={<IconRefresh size={13} />}
          disabled={!canRestart || isBack}
          onClick={() => void restart()}
        >
          {t('restart')}
        </Button>
      </Tooltip>
    </li>
  );
}
