import type { UserCommand } from '@/commands/registry';
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
  IconQuestionMark,
  IconRowInsertBottom,
  IconTrash,
  type Icon,
} from '@tabler/icons-react';
import { areNeighbours } from '@/model/edits';
import { canUnwrap } from '@/model/rules';
import { copySelection, cutSelection } from '@/store/project/edits/clipboard';
import {
  achieve,
  activeDiagram,
  deleteSelection,
  duplicateSelection,
  hasProblem,
  toggleDisabled,
  unwrapSelection,
} from '@/store/project/edits/blocks';
import { setEditor, useEditorStore } from '@/store/project/editor';
import { extractSelection, inlineSelection } from '@/store/project/edits/subtrees';
import { useProjectStore } from '@/store/project';
import { isLookingBack, useMoment } from '@/store/moment/store';
import { askWhy } from '@/store/moment/why';
import { useSessionStore } from '@/store/session/store';
import { showPanel } from '@/workspace/tabs';
import { editSelected, firstSelected, openBlock, toggleFolded, toggleInside } from './selectedBlock';
import { pasteHere } from '../gestures/clipboard';
import { isOnCanvas, isTreeInFront } from '../inFront';
import { openQuickAddHere } from '../quickAdd/open';

/** A command on blocks: an entry of the command table that also appears in the block's menu. */
export interface BlockCommand extends UserCommand {
  icon: Icon;
  /**
   * Returns the key in `canvas:menu` of the command's label, for a block or for the empty canvas; null if the
   * menu leaves it out.
   */
  inMenu: (isOnBlock: boolean) => string | null;
}

const state = () => useProjectStore.getState();
const selectedNode = () => activeDiagram()?.nodes[firstSelected() ?? ''];
const selectedSpec = () => state().vocabulary.specs.get(selectedNode()?.type ?? '');
const childCount = () => selectedNode()?.children?.length ?? 0;
const areDisabled = () => state().selection.every((id) => activeDiagram()?.nodes[id]?.disabled === true);
const isSubTree = () => selectedNode()?.type === 'SubTree';
const opensTree = () => isSubTree() && selectedNode()?.tree !== undefined;
const opensCode = () => selectedSpec()?.source === 'action';
const canLookInside = () => isSubTree() && state().vocabulary.trees.has(selectedNode()?.tree ?? '');
const areSeveral = () => state().selection.length > 1;
const isExtractable = () => {
  const diagram = activeDiagram();
  return areSeveral() ? diagram !== null && areNeighbours(diagram, state().selection) : childCount() > 0;
};
const isLookedInside = () =>
  useEditorStore.getState().expanded[state().activeTree ?? '']?.has(firstSelected() ?? '') === true;

/** Whether the selected block is a part of the tree that runs or ran. */
const hasRun = () => {
  const nodes = isLookingBack() ? useMoment.getState().tree : useSessionStore.getState().tree;
  const [id] = state().selection;
  return nodes.some((node) => node.node_id === id && node.tree_id === state().activeTree);
};

const hasSelection = () => state().selection.length > 0;
const selectedOnCanvas = () => isOnCanvas() && hasSelection();
const selectedInFront = () => hasSelection() && isTreeInFront();

const always = (words: string) => () => words;
/**
 * Wraps a menu label so that a command is left out when several blocks are selected, of which it would change
 * only the first.
 */
const forOne = (words: (isOnBlock: boolean) => string | null) => (isOnBlock: boolean) =>
  areSeveral() && isOnBlock ? null : words(isOnBlock);
const forSeveral = (words: string) => () => (areSeveral() ? words : null);

/** Wraps the selected blocks at once, without the quick-add box. */
function wrapIn(type: 'Sequence' | 'Fallback'): void {
  achieve({ does: 'wrap', nodes: state().selection }, { type });
}

function wordsOfAdding(isOnBlock: boolean): string | null {
  if (!isOnBlock) return 'addBlock';
  return (selectedSpec()?.maxChildren ?? 0) > childCount() ? 'addChild' : null;
}

function wordsOfOpening(): string | null {
  if (opensTree()) return 'openTree';
  return opensCode() ? 'openCode' : null;
}

function canUnwrapSelected(): boolean {
  const diagram = activeDiagram();
  const id = firstSelected();
  return diagram !== null && id !== undefined && canUnwrap(diagram, id, state().vocabulary);
}

/** The commands for selected blocks, in the order of the command palette. */
export const blockCommands: readonly BlockCommand[] = [
  {
    id: 'edit.copy',
    group: 'edit',
    labelKey: 'canvas:menu.copy',
    inMenu: always('copy'),
    icon: IconCopy,
    keys: '$mod+KeyC',
    enabled: selectedOnCanvas,
    run: () => void copySelection(),
  },
  {
    id: 'edit.cut',
    group: 'edit',
    labelKey: 'canvas:menu.cut',
    inMenu: always('cut'),
    icon: IconCut,
    keys: '$mod+KeyX',
    enabled: selectedOnCanvas,
    run: () => void cutSelection(),
  },
  {
    id: 'edit.paste',
    group: 'edit',
    labelKey: 'canvas:menu.paste',
    inMenu: always('paste'),
    icon: IconClipboard,
    keys: '$mod+KeyV',
    enabled: isOnCanvas,
    run: () => void pasteHere(),
  },
  {
    id: 'edit.duplicate',
    group: 'edit',
    labelKey: 'canvas:menu.duplicate',
    inMenu: always('duplicate'),
    icon: IconCopyPlus,
    shortcut: '$mod+KeyD',
    enabled: selectedOnCanvas,
    run: duplicateSelection,
  },
  {
    id: 'edit.delete',
    group: 'edit',
    labelKey: 'canvas:menu.delete',
    inMenu: always('delete'),
    icon: IconTrash,
    keys: 'Delete',
    enabled: selectedInFront,
    run: deleteSelection,
  },
  {
    id: 'canvas.add',
    group: 'canvas',
    labelKey: 'canvas:menu.addBlock',
    inMenu: forOne(wordsOfAdding),
    icon: IconPlus,
    keys: 'Tab',
    enabled: isTreeInFront,
    run: () => {
      openQuickAddHere('child');
    },
  },
  {
    id: 'canvas.addAfter',
    group: 'canvas',
    labelKey: 'canvas:menu.addAfter',
    inMenu: forOne(always('addAfter')),
    icon: IconRowInsertBottom,
    keys: '$mod+Enter',
    enabled: selectedInFront,
    run: () => {
      openQuickAddHere('after');
    },
  },
  {
    id: 'canvas.rename',
    group: 'canvas',
    labelKey: 'canvas:command.rename',
    inMenu: forOne(always('rename')),
    icon: IconForms,
    keys: 'F2',
    enabled: selectedInFront,
    run: () => {
      editSelected('name');
    },
  },
  {
    id: 'canvas.comment',
    group: 'canvas',
    labelKey: 'canvas:command.comment',
    inMenu: forOne(always('comment')),
    icon: IconMessage2,
    keys: 'Slash',
    enabled: selectedInFront,
    run: () => {
      editSelected('comment');
    },
  },
  {
    id: 'canvas.open',
    group: 'canvas',
    labelKey: 'canvas:command.open',
    inMenu: forOne(wordsOfOpening),
    icon: IconCode,
    keys: 'Enter',
    enabled: () => isTreeInFront() && (opensTree() || opensCode()),
    run: () => {
      const diagram = activeDiagram();
      if (diagram) openBlock(diagram, firstSelected() ?? '');
    },
  },
  {
    id: 'canvas.fold',
    group: 'canvas',
    labelKey: 'canvas:command.fold',
    inMenu: forOne(() => (childCount() === 0 ? null : selectedNode()?.collapsed ? 'unfold' : 'fold')),
    icon: IconFold,
    keys: 'Space',
    enabled: () => isTreeInFront() && childCount() > 0,
    run: toggleFolded,
  },
  {
    id: 'canvas.wrap',
    group: 'canvas',
    labelKey: 'canvas:menu.wrap',
    inMenu: always('wrap'),
    icon: IconBox,
    shortcut: '$mod+KeyG',
    enabled: selectedInFront,
    run: () => {
      openQuickAddHere('wrap');
    },
  },
  ...(['Sequence', 'Fallback'] as const).map((type): BlockCommand => ({
    id: `canvas.wrap${type}`,
    group: 'canvas',
    labelKey: `canvas:menu.wrap${type}`,
    inMenu: forSeveral(`wrap${type}`),
    icon: IconBox,
    enabled: selectedInFront,
    run: () => wrapIn(type),
  })),
  {
    id: 'canvas.unwrap',
    group: 'canvas',
    labelKey: 'canvas:menu.unwrap',
    inMenu: forOne(() => (canUnwrapSelected() ? 'unwrap' : null)),
    icon: IconBoxOff,
    shortcut: '$mod+Shift+KeyG',
    enabled: selectedInFront,
    run: unwrapSelection,
  },
  {
    id: 'canvas.morph',
    group: 'canvas',
    labelKey: 'canvas:menu.morph',
    inMenu: forOne(always('morph')),
    icon: IconArrowsExchange,
    shortcut: '$mod+KeyM',
    enabled: selectedInFront,
    run: () => {
      openQuickAddHere('morph');
    },
  },
  {
    id: 'canvas.disable',
    group: 'canvas',
    labelKey: 'canvas:menu.disable',
    inMenu: () => (areDisabled() ? 'enable' : 'disable'),
    icon: IconBan,
    shortcut: '$mod+KeyE',
    enabled: selectedInFront,
    run: toggleDisabled,
  },
  {
    id: 'canvas.fix',
    group: 'canvas',
    labelKey: 'canvas:menu.fix',
    inMenu: forOne(() => (hasProblem(firstSelected()) ? 'fix' : null)),
    icon: IconBulb,
    shortcut: '$mod+Period',
    enabled: () => hasProblem(firstSelected()),
    run: () => {
      // The box opens after the menu has returned the focus.
      setTimeout(() => {
        setEditor({ fixing: firstSelected() ?? null });
      });
    },
  },
  {
    id: 'canvas.why',
    group: 'canvas',
    labelKey: 'canvas:menu.why',
    inMenu: forOne(() => (hasRun() ? 'why' : null)),
    icon: IconQuestionMark,
    shortcut: 'Alt+KeyW',
    enabled: () => !areSeveral() && hasRun(),
    run: () => {
      showPanel('inspector');
      // The menu returns the focus first.
      setTimeout(askWhy);
    },
  },
  {
    id: 'canvas.extract',
    group: 'canvas',
    labelKey: 'canvas:menu.extract',
    inMenu: () => (isExtractable() ? 'extract' : null),
    icon: IconBinaryTree,
    enabled: () => isTreeInFront() && isExtractable(),
    run: extractSelection,
  },
  {
    id: 'canvas.look',
    group: 'canvas',
    labelKey: 'canvas:command.look',
    inMenu: forOne(() => (canLookInside() ? (isLookedInside() ? 'lookAway' : 'lookInside') : null)),
    icon: IconFold,
    keys: 'Space',
    enabled: () => isTreeInFront() && canLookInside(),
    run: toggleInside,
  },
  {
    id: 'canvas.inline',
    group: 'canvas',
    labelKey: 'canvas:menu.inline',
    inMenu: forOne(() => (isSubTree() ? 'inline' : null)),
    icon: IconBoxOff,
    enabled: () => isTreeInFront() && isSubTree(),
    run: inlineSelection,
  },
];
