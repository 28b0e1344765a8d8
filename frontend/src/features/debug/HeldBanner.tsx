import { Group } from '@mantine/core';
import { IconHandStop } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { Held, TreeNode } from '@/generated/messages';
import { isOwnTree, nodesOf } from '@/store/debug/debugger';
import { useProjectStore } from '@/store/project';
import { openTree } from '@/store/project/navigation';
import { useIsBack } from '@/store/moment/store';
import { usePython } from '@/store/python/stop';
import { useSessionStore } from '@/store/session/store';
import { CommandButton } from '@/ui/CommandButton';
import { useHeldWords } from './words';
import { heldCommands } from './commands';
import { TickBackButton } from '@/features/run/TickBackButton';
import classes from './debug.module.css';

/** The banner of a held tree: where and why it is held, and how to continue; nothing while it is not held. */
export function HeldBanner() {
  const held = useSessionStore((state) => state.held);
  const tree = useSessionStore((state) => state.tree);
  const isBack = useIsBack();
  const isInPython = usePython(({ stop }) => stop !== null);
  const node = held ? tree[held.uid - 1] : undefined;
  if (!held || !node || isBack || isInPython) return null;
  return <Banner held={held} node={node} tree={tree} />;
}

interface BannerProps {
  readonly held: Held;
  readonly node: TreeNode;
  readonly tree: readonly TreeNode[];
}

function Banner({ held, node, tree }: BannerProps) {
  const { t } = useTranslation('debug');
  const isDriver = useSessionStore(({ introspection }) => introspection?.role === 'driver');
  const hasTarget = useProjectStore(
    ({ activeTree, selection: [id] }) => nodesOf({ tree }, activeTree ?? '', id ?? '').length > 0,
  );
  const canStep = useSessionStore(isOwnTree);
  const words = useHeldWords();
  const path = held.path.flatMap((uid) => tree[uid - 1]?.name ?? []);
  const reveal = () => {
    openTree(node.tree_id);
    useProjectStore.getState().reveal(node.tree_id, node.node_id);
  };
  return (
    <section className={classes['banner']} aria-label={t('held')} data-testid="held-banner">
      <IconHandStop size={18} aria-hidden="true" />
      <div className={classes['words']} role="status">
        {t('heldAt')}{' '}
        <button type="button" className={classes['place']} onClick={reveal} data-testid="held-node">
          {node.name}
        </button>{' '}
        <span>{words(held)}</span> {held.outside && <strong>{t('outside')} </strong>}
        {!canStep && <span>{t('heldUntil')} </span>}
        <small className={classes['path']} title={t('path')} data-testid="held-path">
          {path.join(' › ')}
        </small>
      </div>
      {isDriver && (
        <Group gap={2} wrap="nowrap">
          {(canStep ? [...heldCommands.map(({ id }) => id), 'debug.to'] : ['debug.continue']).map((id) => (
            <CommandButton
              key={id}
              command={id}
              testId={id.replace('.', '-')}
              isDisabled={id === 'debug.to' && !hasTarget}
            />
          ))}
          {canStep && <TickBackButton />}
        </Group>
      )}
    </section>
  );
}
