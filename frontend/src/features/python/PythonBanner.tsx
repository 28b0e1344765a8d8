import { Button, Group } from '@mantine/core';
import { IconHandStop } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { TreeNode } from '@/generated/messages';
import { nameOf } from '@/features/why/sentence';
import { TickBackButton } from '@/features/run/TickBackButton';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { shownFrame, usePython } from '@/store/python/stop';
import { useSessionStore } from '@/store/session/store';
import { CommandButton } from '@/ui/CommandButton';
import { showPanel } from '@/workspace/tabs';
import classes from './python.module.css';

const COMMANDS = ['debug.continue', 'debug.over', 'debug.into', 'debug.out'];

/** The banner of a program that is held at a line of Python; nothing while none is. */
export function PythonBanner() {
  const { t } = useTranslation('debug');
  const stop = usePython((state) => state.stop);
  const frame = usePython(shownFrame);
  const isHeld = useSessionStore(({ executor, held }) => executor === 'held' && held === null);
  const hold = useSessionStore((state) => state.heldInPython);
  const nodes = useSessionStore((state) => state.tree);
  if (!stop && !isHeld) return null;
  return (
    <section className={classes['banner']} aria-label={t('python.held')} data-testid="python-banner">
      <IconHandStop size={18} aria-hidden="true" />
      <div className={classes['words']} role="status" title={stop?.text}>
        {stop && frame ? (
          <>
            {t('python.heldIn', { name: frame.name })}{' '}
            <button
              type="button"
              className={classes['place']}
              onClick={() => openFile(frame.path, frame.line)}
              disabled={!frame.path}
              data-testid="python-place"
            >
              {frame.path}:{frame.line}
            </button>{' '}
            {hold && <HeldBlock nodes={nodes} uid={hold.uid} />}
            {stop.text || t(`python.reason.${stop.reason}`, { defaultValue: '' })}
          </>
        ) : (
          t('python.heldElsewhere')
        )}
      </div>
      {stop && (
        <Group gap={2} wrap="nowrap">
          <Button
            size="compact-sm"
            variant="subtle"
            data-testid="python-values"
            onClick={() => showPanel('breakpoints')}
          >
            {t('python.variables')}
          </Button>
          {COMMANDS.map((id) => (
            <CommandButton key={id} command={id} testId={id.replace('.', '-')} />
          ))}
          <TickBackButton />
        </Group>
      )}
    </section>
  );
}

interface HeldBlockProps {
  readonly nodes: readonly TreeNode[];
  readonly uid: number;
}

/** The block whose code is held: its name, and its place, since two blocks can have one name. */
function HeldBlock({ nodes, uid }: HeldBlockProps) {
  const { t } = useTranslation('debug');
  const node = nodes[uid - 1];
  if (!node) return null;
  const parent = nodes[node.parent - 1];
  const siblings = nodes.filter((each) => each.parent === node.parent);
  const place = { at: siblings.indexOf(node) + 1, count: siblings.length };
  const words = { name: nameOf(node), parent: nameOf(parent), ...place };
  const show = () => useProjectStore.getState().reveal(node.tree_id, node.node_id);
  return (
    <>
      <button type="button" className={classes['place']} onClick={show} data-testid="python-block">
        {t(`python.${parent ? (place.count > 1 ? 'block' : 'onlyChild') : 'rootBlock'}`, words)}
      </button>{' '}
    </>
  );
}
