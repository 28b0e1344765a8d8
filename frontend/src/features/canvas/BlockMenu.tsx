import { Menu } from '@mantine/core';
import { Fragment } from 'react';
import { useTranslation } from 'react-i18next';
import { keysOf } from '@/commands/shortcuts';
import { PointTarget } from '@/ui/PointTarget';
import { blockCommands, type BlockCommand } from './commands/blockCommands';
import { debugCommands } from './commands/debugCommands';
import { levelCommands } from './commands/levelCommands';

export interface MenuPoint {
  readonly x: number;
  readonly y: number;
  readonly isOnBlock: boolean;
}

/** The groups of a block's menu, by the `id` of the commands. */
const ON_BLOCK = [
  ['canvas.fix', 'canvas.why'],
  ['canvas.look'],
  ['canvas.open'],
  [
    'canvas.add',
    'canvas.addAfter',
    'canvas.wrap',
    'canvas.wrapSequence',
    'canvas.wrapFallback',
    'canvas.unwrap',
    'canvas.morph',
    'canvas.extract',
    'canvas.inline',
  ],
  ['canvas.rename', 'canvas.comment', 'canvas.disable', 'canvas.fold'],
  debugCommands.map(({ id }) => id),
  ['edit.cut', 'edit.copy', 'edit.paste', 'edit.duplicate'],
  ['edit.delete'],
];
const BESIDE_BLOCKS = [['canvas.add', 'edit.paste'], levelCommands.map(({ id }) => id)];
const DANGEROUS: ReadonlySet<string> = new Set(['edit.delete']);

interface Item {
  readonly words: string;
  readonly action: BlockCommand;
}

const byId = new Map(
  [...blockCommands, ...debugCommands, ...levelCommands].map((action) => [action.id, action]),
);

/** Returns the commands that are available now, in groups. */
function itemsFor(isOnBlock: boolean): Item[][] {
  const offered = (id: string): Item[] => {
    const action = byId.get(id);
    const words = action?.inMenu(isOnBlock) ?? null;
    return action && words !== null ? [{ words, action }] : [];
  };
  const groups = isOnBlock ? ON_BLOCK : BESIDE_BLOCKS;
  return groups.map((ids) => ids.flatMap(offered)).filter((items) => items.length > 0);
}

interface BlockMenuProps {
  readonly point: MenuPoint | null;
  readonly onClose: () => void;
}

/** The context menu of the canvas and its blocks. */
export function BlockMenu({ point, onClose }: BlockMenuProps) {
  const { t } = useTranslation('canvas');
  if (!point) return null;
  return (
    <Menu
      opened
      withInitialFocusPlaceholder={false}
      onClose={onClose}
      position="bottom-start"
      offset={2}
      width={284}
      returnFocus={false}
    >
      <PointTarget
        x={point.x}
        y={point.y}
        label={t(point.isOnBlock ? 'menu.ofBlocks' : 'menu.ofCanvas')}
        onClose={onClose}
      />
      <Menu.Dropdown
        onContextMenu={(event) => {
          event.preventDefault();
        }}
      >
        {itemsFor(point.isOnBlock).map((items, index) => (
          <Fragment key={items[0]?.words}>
            {index > 0 && <Menu.Divider />}
            {items.map(({ words, action }) => (
              <Menu.Item
                key={words}
                leftSection={<action.icon size={16} stroke={1.7} aria-hidden="true" />}
                rightSection={
                  <kbd style={{ color: 'var(--bts-muted)', fontSize: 11, fontFamily: 'inherit' }}>
                    {keysOf(action)}
                  </kbd>
                }
                {...(DANGEROUS.has(action.id) ? { color: 'var(--bts-failure)' } : {})}
                onClick={() => {
                  action.run();
                }}
                data-testid={`menu-${words}`}
              >
                {t(`menu.${words}`)}
              </Menu.Item>
            ))}
          </Fragment>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}
