import { undoTarget } from '@/actions/undo';
import { registerActions, type UserAction } from '@/actions/registry';
import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconArrowsExchange,
  IconBan,
  IconBinaryTree,
  IconBox,
  IconBoxOff,
  IconBulb,
  IconClipboard,
  IconCopy,
  IconCopyPlus,
  IconCut,
  IconFocusCentered,
  IconLayoutDistributeHorizontal,
  IconMap2,
  IconMaximize,
  IconPlus,
  IconSearch,
  IconZoomIn,
  IconZoomOut,
} from '@tabler/icons-react';
import { setLayout, tidy } from '@/model/edits';
import { copySelection, cutSelection, paste } from '@/store/project/clipboard';
import {
  activeDiagram,
  change,
  duplicateSelection,
  hasProblem,
  toggleDisabled,
  unwrapSelection,
} from '@/store/project/commands';
import { isMinimapShown, setEditor, toggleExpanded } from '@/store/project/editor';
import { extractSelection, inlineSelection } from '@/store/project/subtrees';
import { useProjectStore } from '@/store/project';
import { openQuickAddHere } from './quickAdd/open';
import { fit, fitSelection, isTreeShown, zoomIn, zoomOut, zoomReset } from './views';

const state = () => useProjectStore.getState();
const history = () => state().histories[state().activeTree ?? ''];
const canRedo = () => undoTarget()?.canRedo ?? (history()?.future.length ?? 0) > 0;
/** A universe or a robot that is in front has steps of its own. */
const undoInFront = () => (undoTarget() ? undoTarget()?.travel('undo') : state().undo());
const redoInFront = () => (undoTarget() ? undoTarget()?.travel('redo') : state().redo());
const hasTree = () => activeDiagram() !== null;
const selectedNode = () => activeDiagram()?.nodes[state().selection[0] ?? ''];
const hasSelection = () => state().selection.length > 0;

/** Keys for blocks count only while the canvas has the focus: elsewhere they belong to text. */
const onCanvas = () => document.activeElement?.closest('[data-testid="canvas"]') !== null;
const selectedOnCanvas = () => onCanvas() && hasSelection();

const rows: readonly UserAction[] = [
  {
    id: 'edit.undo',
    group: 'edit',
    labelKey: 'canvas:action.undo',
    icon: IconArrowBackUp,
    shortcut: '$mod+KeyZ',
    enabled: () => undoTarget()?.canUndo ?? (history()?.past.length ?? 0) > 0,
    run: undoInFront,
  },
  {
    id: 'edit.redo',
    group: 'edit',
    labelKey: 'canvas:action.redo',
    icon: IconArrowForwardUp,
    shortcut: '$mod+KeyY',
    enabled: canRedo,
    run: redoInFront,
  },
  {
    id: 'edit.redoShift',
    group: 'edit',
    labelKey: 'canvas:action.redo',
    shortcut: '$mod+Shift+KeyZ',
    hidden: true,
    enabled: canRedo,
    run: redoInFront,
  },
  {
    id: 'edit.copy',
    group: 'edit',
    labelKey: 'canvas:menu.copy',
    icon: IconCopy,
    enabled: selectedOnCanvas,
    run: () => void copySelection(),
  },
  {
    id: 'edit.cut',
    group: 'edit',
    labelKey: 'canvas:menu.cut',
    icon: IconCut,
    enabled: selectedOnCanvas,
    run: () => void cutSelection(),
  },
  {
    id: 'edit.paste',
    group: 'edit',
    labelKey: 'canvas:menu.paste',
    icon: IconClipboard,
    enabled: onCanvas,
    run: () => void paste(),
  },
  {
    id: 'edit.duplicate',
    group: 'edit',
    labelKey: 'canvas:menu.duplicate',
    icon: IconCopyPlus,
    shortcut: '$mod+KeyD',
    enabled: selectedOnCanvas,
    run: duplicateSelection,
  },
  {
    id: 'edit.selectAll',
    group: 'edit',
    labelKey: 'canvas:action.selectAll',
    shortcut: '$mod+KeyA',
    enabled: onCanvas,
    run: () => {
      const diagram = activeDiagram();
      if (diagram) state().select(diagram.id, Object.keys(diagram.nodes));
    },
  },
  {
    id: 'canvas.add',
    group: 'canvas',
    labelKey: 'canvas:menu.addBlock',
    icon: IconPlus,
    enabled: hasTree,
    run: () => {
      openQuickAddHere('child');
    },
  },
  {
    id: 'canvas.wrap',
    group: 'canvas',
    labelKey: 'canvas:menu.wrap',
    icon: IconBox,
    shortcut: '$mod+KeyG',
    enabled: hasSelection,
    run: () => {
      openQuickAddHere('wrap');
    },
  },
  {
    id: 'canvas.unwrap',
    group: 'canvas',
    labelKey: 'canvas:menu.unwrap',
    icon: IconBoxOff,
    shortcut: '$mod+Shift+KeyG',
    enabled: hasSelection,
    run: unwrapSelection,
  },
  {
    id: 'canvas.morph',
    group: 'canvas',
    labelKey: 'canvas:menu.morph',
    icon: IconArrowsExchange,
    shortcut: '$mod+KeyM',
    enabled: hasSelection,
    run: () => {
      openQuickAddHere('morph');
    },
  },
  {
    id: 'canvas.disable',
    group: 'canvas',
    labelKey: 'canvas:menu.disable',
    icon: IconBan,
    shortcut: '$mod+KeyE',
    enabled: hasSelection,
    run: toggleDisabled,
  },
  {
    id: 'canvas.fix',
    group: 'canvas',
    labelKey: 'canvas:menu.fix',
    icon: IconBulb,
    shortcut: '$mod+Period',
    enabled: () => hasProblem(state().selection[0]),
    run: () => {
      setEditor({ fixing: state().selection[0] ?? null });
    },
  },
  {
    id: 'canvas.extract',
    group: 'canvas',
    labelKey: 'canvas:menu.extract',
    icon: IconBinaryTree,
    enabled: hasSelection,
    run: extractSelection,
  },
  {
    id: 'canvas.look',
    group: 'canvas',
    labelKey: 'canvas:menu.lookInside',
    enabled: () => selectedNode()?.type === 'SubTree',
    run: () => {
      const { activeTree, selection } = state();
      if (activeTree !== null && selection[0] !== undefined) toggleExpanded(activeTree, selection[0]);
    },
  },
  {
    id: 'canvas.inline',
    group: 'canvas',
    labelKey: 'canvas:menu.inline',
    icon: IconBoxOff,
    enabled: hasSelection,
    run: inlineSelection,
  },
  {
    id: 'canvas.find',
    group: 'canvas',
    labelKey: 'canvas:action.find',
    icon: IconSearch,
    shortcut: '$mod+KeyF',
    enabled: onCanvas,
    run: () => {
      setEditor({ find: true });
    },
  },
  {
    id: 'canvas.tidy',
    group: 'canvas',
    labelKey: 'canvas:toolbar.tidy',
    icon: IconLayoutDistributeHorizontal,
    enabled: hasTree,
    run: () => {
      change('tidy', [tidy()]);
    },
  },
  {
    id: 'canvas.orientation',
    group: 'canvas',
    labelKey: 'canvas:action.orientation',
    enabled: hasTree,
    run: () => {
      const diagram = activeDiagram();
      if (diagram)
        change('orientation', [setLayout(diagram.layout === 'vertical' ? 'horizontal' : 'vertical')]);
    },
  },
];

/** Figma's keys for the same. */
export const FIT_KEYS = { all: 'Shift+Digit1', selection: 'Shift+Digit2' } as const;

const views: readonly UserAction[] = [
  {
    id: 'canvas.fit',
    group: 'canvas',
    labelKey: 'canvas:toolbar.fit',
    icon: IconMaximize,
    shortcut: FIT_KEYS.all,
    enabled: isTreeShown,
    run: fit,
  },
  {
    id: 'canvas.fitSelection',
    group: 'canvas',
    labelKey: 'canvas:toolbar.fitSelection',
    icon: IconFocusCentered,
    shortcut: FIT_KEYS.selection,
    enabled: () => isTreeShown() && hasSelection(),
    run: fitSelection,
  },
  {
    id: 'canvas.zoomIn',
    group: 'canvas',
    labelKey: 'canvas:toolbar.zoomIn',
    icon: IconZoomIn,
    enabled: isTreeShown,
    run: zoomIn,
  },
  {
    id: 'canvas.zoomOut',
    group: 'canvas',
    labelKey: 'canvas:toolbar.zoomOut',
    icon: IconZoomOut,
    enabled: isTreeShown,
    run: zoomOut,
  },
  {
    id: 'canvas.zoomReset',
    group: 'canvas',
    labelKey: 'canvas:toolbar.zoomReset',
    enabled: isTreeShown,
    run: zoomReset,
  },
  {
    id: 'canvas.minimap',
    group: 'canvas',
    labelKey: 'canvas:toolbar.minimap',
    icon: IconMap2,
    enabled: hasTree,
    run: () => {
      const blocks = Object.keys(activeDiagram()?.nodes ?? {}).length;
      setEditor(({ minimap }) => ({ minimap: !isMinimapShown(minimap, blocks) }));
    },
  },
];

/** Adds the editor's commands to the table; the returned function takes them out again. */
export function registerCanvasActions(): () => void {
  return registerActions([...rows, ...views]);
}
