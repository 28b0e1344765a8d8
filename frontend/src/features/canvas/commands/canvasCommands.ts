import { undoTarget } from '@/commands/undo';
import { registerCommands, type UserCommand } from '@/commands/registry';
import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconArrowsHorizontal,
  IconArrowsVertical,
  IconFocusCentered,
  IconLayoutDistributeHorizontal,
  IconLayoutList,
  IconMap2,
  IconMaximize,
  IconSearch,
  IconZoomIn,
  IconZoomOut,
} from '@tabler/icons-react';
import { setLayout, tidy } from '@/model/edits';
import { activeDiagram, change } from '@/store/project/edits/blocks';
import { isMinimapShown, setEditor } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { toggleCompact } from '../view/compact';
import { blockCommands } from './blockCommands';
import { debugCommands } from './debugCommands';
import { levelCommands } from './levelCommands';
import { valuesCommand } from './shownValues';
import { followClipboard } from '../gestures/clipboard';
import { isOnCanvas, isTreeInFront } from '../inFront';
import { fit, fitSelection, isTreeShown, zoomIn, zoomOut, zoomReset } from '../view/views';

const state = () => useProjectStore.getState();
const undoStack = () => state().histories[state().activeTree ?? ''];
const canRedo = () => undoTarget()?.canRedo ?? (undoStack()?.future.length ?? 0) > 0;
/** Undoes a step of the universe or robot in front if there is one, otherwise of the tree. */
const undoInFront = () => (undoTarget() ? undoTarget()?.travel('undo') : state().undo());
const redoInFront = () => (undoTarget() ? undoTarget()?.travel('redo') : state().redo());
const hasTree = () => activeDiagram() !== null;
const hasSelection = () => state().selection.length > 0;

const rows: readonly UserCommand[] = [
  {
    id: 'edit.undo',
    group: 'edit',
    labelKey: 'canvas:command.undo',
    icon: IconArrowBackUp,
    shortcut: '$mod+KeyZ',
    enabled: () => undoTarget()?.canUndo ?? (undoStack()?.past.length ?? 0) > 0,
    run: undoInFront,
  },
  {
    id: 'edit.redo',
    group: 'edit',
    labelKey: 'canvas:command.redo',
    icon: IconArrowForwardUp,
    shortcut: '$mod+KeyY',
    enabled: canRedo,
    run: redoInFront,
  },
  {
    id: 'edit.redoShift',
    group: 'edit',
    labelKey: 'canvas:command.redo',
    shortcut: '$mod+Shift+KeyZ',
    hidden: true,
    enabled: canRedo,
    run: redoInFront,
  },
  {
    id: 'edit.selectAll',
    group: 'edit',
    labelKey: 'canvas:command.selectAll',
    shortcut: '$mod+KeyA',
    enabled: isOnCanvas,
    run: () => {
      const diagram = activeDiagram();
      if (diagram) state().select(diagram.id, Object.keys(diagram.nodes));
    },
  },
  valuesCommand,
  {
    id: 'canvas.find',
    group: 'canvas',
    labelKey: 'canvas:command.find',
    icon: IconSearch,
    shortcut: '$mod+KeyF',
    enabled: isTreeInFront,
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
  ...(['vertical', 'horizontal'] as const).map((layout): UserCommand => ({
    id: `canvas.${layout}`,
    group: 'canvas',
    labelKey: `canvas:toolbar.${layout}`,
    icon: layout === 'vertical' ? IconArrowsVertical : IconArrowsHorizontal,
    enabled: () => hasTree() && activeDiagram()?.layout !== layout,
    run: () => {
      change('orientation', [setLayout(layout)]);
    },
  })),
];

/** The keys that fit the view, as in Figma. */
export const FIT_KEYS = { all: 'Shift+Digit1', selection: 'Shift+Digit2' } as const;

const views: readonly UserCommand[] = [
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
  {
    id: 'canvas.compact',
    group: 'canvas',
    labelKey: 'canvas:command.compact',
    icon: IconLayoutList,
    enabled: hasTree,
    run: toggleCompact,
  },
];

/** Registers the commands of the canvas and listens to the clipboard; returns a function that undoes both. */
export function registerCanvasCommands(): () => void {
  const ends = [
    registerCommands([...rows, ...blockCommands, ...debugCommands, ...levelCommands, ...views]),
    followClipboard(),
  ];
  return () => ends.forEach((end) => end());
}
