import { Menu } from '@mantine/core';
import {
  IconArrowsExchange,
  IconBan,
  IconBinaryTree,
  IconBox,
  IconBoxOff,
  IconBulb,
  IconClipboard,
  IconCode,
  IconCopy,
  IconCopyPlus,
  IconCut,
  IconFold,
  IconForms,
  IconMessage2,
  IconPlus,
  IconRowInsertBottom,
  IconTrash,
  type Icon,
} from '@tabler/icons-react';
import { Fragment } from 'react';
import { useTranslation } from 'react-i18next';
import { childrenOf } from '@/model/diagram';
import { setCollapsed } from '@/model/edits';
import { canUnwrap } from '@/model/rules';
import { copySelection, cutSelection, paste } from '@/store/project/clipboard';
import {
  activeDiagram,
  change,
  deleteSelection,
  duplicateSelection,
  hasProblem,
  toggleDisabled,
  unwrapSelection,
} from '@/store/project/commands';
import { setEditor, toggleExpanded, useEditorStore } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { extractSelection, inlineSelection } from '@/store/project/subtrees';
import { openBlock } from './keyboard';
import { openQuickAddHere } from './quickAdd/open';

export interface MenuPoint {
  readonly x: number;
  readonly y: number;
  readonly onBlock: boolean;
}

interface Item {
  readonly key: string;
  readonly icon: Icon;
  readonly keys?: string;
  readonly run: () => void;
  readonly isDangerous?: boolean;
}

/** What can be done with the selected block now, in groups. */
function itemsFor(): Item[][] {
  const diagram = activeDiagram();
  const { selection, vocabulary } = useProjectStore.getState();
  const [id] = selection;
  const node = id === undefined ? undefined : diagram?.nodes[id];
  if (!diagram || id === undefined || !node) return [];
  const spec = vocabulary.specs.get(node.type);
  const hasChildren = childrenOf(diagram, id).length > 0;
  const opens = spec?.source === 'action' || (node.type === 'SubTree' && node.tree !== undefined);
  const when = (condition: boolean, item: Item): Item[] => (condition ? [item] : []);
  return [
    when(hasProblem(id), {
      key: 'fix',
      icon: IconBulb,
      keys: 'Ctrl+.',
      run: () => {
        // After the menu has given the focus back.
        setTimeout(() => {
          setEditor({ fixing: id });
        });
      },
    }),
    when(node.type === 'SubTree' && vocabulary.trees.has(node.tree ?? ''), {
      key: useEditorStore.getState().expanded[diagram.id]?.has(id) ? 'lookAway' : 'lookInside',
      icon: IconFold,
      keys: 'Space',
      run: () => {
        toggleExpanded(diagram.id, id);
      },
    }),
    when(opens, {
      key: node.type === 'SubTree' ? 'openTree' : 'openCode',
      icon: node.type === 'SubTree' ? IconBinaryTree : IconCode,
      keys: 'Enter',
      run: () => {
        openBlock(diagram, id);
      },
    }),
    [
      ...when((spec?.maxChildren ?? 0) > childrenOf(diagram, id).length, {
        key: 'addChild',
        icon: IconPlus,
        keys: 'Tab',
        run: () => {
          openQuickAddHere('child');
        },
      }),
      {
        key: 'addAfter',
        icon: IconRowInsertBottom,
        keys: 'Ctrl+Enter',
        run: () => {
          openQuickAddHere('after');
        },
      },
      {
        key: 'wrap',
        icon: IconBox,
        keys: 'Ctrl+G',
        run: () => {
          openQuickAddHere('wrap');
        },
      },
      ...when(canUnwrap(diagram, id, vocabulary), {
        key: 'unwrap',
        icon: IconBoxOff,
        keys: 'Shift+Del',
        run: unwrapSelection,
      }),
      {
        key: 'morph',
        icon: IconArrowsExchange,
        keys: 'Ctrl+M',
        run: () => {
          openQuickAddHere('morph');
        },
      },
      ...when(hasChildren || selection.length > 1, {
        key: 'extract',
        icon: IconBinaryTree,
        run: extractSelection,
      }),
      ...when(node.type === 'SubTree', { key: 'inline', icon: IconBoxOff, run: inlineSelection }),
    ],
    [
      {
        key: 'rename',
        icon: IconForms,
        keys: 'F2',
        run: () => {
          setEditor({ editing: { node: id, field: 'name' } });
        },
      },
      {
        key: 'comment',
        icon: IconMessage2,
        keys: '/',
        run: () => {
          setEditor({ editing: { node: id, field: 'comment' } });
        },
      },
      { key: node.disabled ? 'enable' : 'disable', icon: IconBan, keys: 'Ctrl+E', run: toggleDisabled },
      ...when(hasChildren, {
        key: node.collapsed ? 'unfold' : 'fold',
        icon: IconFold,
        keys: 'Space',
        run: () => {
          change(node.collapsed ? 'unfold' : 'fold', [setCollapsed(id, !node.collapsed)]);
        },
      }),
    ],
    [
      { key: 'cut', icon: IconCut, keys: 'Ctrl+X', run: () => void cutSelection() },
      { key: 'copy', icon: IconCopy, keys: 'Ctrl+C', run: () => void copySelection() },
      { key: 'paste', icon: IconClipboard, keys: 'Ctrl+V', run: () => void paste() },
      { key: 'duplicate', icon: IconCopyPlus, keys: 'Ctrl+D', run: duplicateSelection },
    ],
    [{ key: 'delete', icon: IconTrash, keys: 'Del', run: deleteSelection, isDangerous: true }],
  ].filter((group) => group.length > 0);
}

function paneItems(): Item[][] {
  return [
    [
      {
        key: 'addBlock',
        icon: IconPlus,
        keys: 'Tab',
        run: () => {
          openQuickAddHere('child');
        },
      },
      { key: 'paste', icon: IconClipboard, keys: 'Ctrl+V', run: () => void paste() },
    ],
  ];
}

interface BlockMenuProps {
  readonly point: MenuPoint | null;
  readonly onClose: () => void;
}

/** The menu of the right mouse button. */
export function BlockMenu({ point, onClose }: BlockMenuProps) {
  const { t } = useTranslation('canvas');
  if (!point) return null;
  const groups = point.onBlock ? itemsFor() : paneItems();
  return (
    <Menu opened onClose={onClose} position="bottom-start" offset={2} width={252} returnFocus={false}>
      <Menu.Target>
        <span style={{ position: 'fixed', left: point.x, top: point.y, width: 1, height: 1 }} />
      </Menu.Target>
      <Menu.Dropdown
        onContextMenu={(event) => {
          event.preventDefault();
        }}
      >
        {groups.map((group, index) => (
          <Fragment key={group[0]?.key}>
            {index > 0 && <Menu.Divider />}
            {group.map(({ key, icon: Symbol, keys, run, isDangerous }) => (
              <Menu.Item
                key={key}
                leftSection={<Symbol size={16} stroke={1.7} aria-hidden="true" />}
                rightSection={
                  <kbd style={{ color: 'var(--bts-muted)', fontSize: 11, fontFamily: 'inherit' }}>{keys}</kbd>
                }
                {...(isDangerous ? { color: 'var(--bts-failure)' } : {})}
                onClick={run}
                data-testid={`menu-${key}`}
              >
                {t(`menu.${key}`)}
              </Menu.Item>
            ))}
          </Fragment>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}
