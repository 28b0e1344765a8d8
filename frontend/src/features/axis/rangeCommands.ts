import {
  IconArrowAutofitWidth,
  IconArrowsDiff,
  IconBracketsOff,
  IconRepeat,
  IconSquareLetterA,
  IconSquareLetterB,
  IconZoomIn,
  IconZoomOut,
} from '@tabler/icons-react';
import type { UserCommand } from '@/commands/registry';
import { extent } from '@/store/moment/looking';
import { markedRange, useRange, zoomed } from '@/store/moment/range';
import { useMoment } from '@/store/moment/store';

const ZOOM_STEP = 1.5;
const hasRecording = () => extent() !== null;

/** Marks the shown moment, or the end of the run at the present. */
function mark(name: 'a' | 'b'): void {
  const t = useMoment.getState().t ?? extent()?.to;
  if (t !== undefined) useRange.setState({ [name]: t });
}

/** Zooms round a time, or the shown moment. */
export function zoom(factor: number, round?: number): void {
  const all = extent();
  if (!all) return;
  const { view } = useRange.getState();
  useRange.setState({ view: zoomed(view, all, factor, round ?? useMoment.getState().t ?? all.to) });
}

export const rangeCommands: readonly UserCommand[] = [
  {
    id: 'time.markA',
    group: 'run',
    labelKey: 'axis:command.markA',
    icon: IconSquareLetterA,
    shortcut: 'Alt+BracketLeft',
    enabled: hasRecording,
    run: () => mark('a'),
  },
  {
    id: 'time.markB',
    group: 'run',
    labelKey: 'axis:command.markB',
    icon: IconSquareLetterB,
    shortcut: 'Alt+BracketRight',
    enabled: hasRecording,
    run: () => mark('b'),
  },
  {
    id: 'time.loop',
    group: 'run',
    labelKey: 'axis:command.loop',
    icon: IconRepeat,
    shortcut: 'Alt+KeyL',
    enabled: () => hasRecording() && markedRange(useRange.getState()) !== null,
    run: () => useRange.setState(({ isLooping }) => ({ isLooping: !isLooping })),
  },
  {
    id: 'time.clearRange',
    group: 'run',
    labelKey: 'axis:command.clearRange',
    icon: IconBracketsOff,
    enabled: () => useRange.getState().a !== null || useRange.getState().b !== null,
    run: () => useRange.setState({ a: null, b: null, isLooping: false, isComparing: false }),
  },
  {
    id: 'time.whatChanged',
    group: 'run',
    labelKey: 'axis:command.whatChanged',
    icon: IconArrowsDiff,
    shortcut: 'Alt+KeyD',
    enabled: () => hasRecording() && useRange.getState().a !== null,
    run: () => useRange.setState(({ isComparing }) => ({ isComparing: !isComparing })),
  },
  {
    id: 'time.zoomIn',
    group: 'run',
    labelKey: 'axis:command.zoomIn',
    icon: IconZoomIn,
    shortcut: 'Alt+Equal',
    enabled: hasRecording,
    run: () => zoom(1 / ZOOM_STEP),
  },
  {
    id: 'time.zoomOut',
    group: 'run',
    labelKey: 'axis:command.zoomOut',
    icon: IconZoomOut,
    shortcut: 'Alt+Minus',
    enabled: () => useRange.getState().view !== null,
    run: () => zoom(ZOOM_STEP),
  },
  {
    id: 'time.fit',
    group: 'run',
    labelKey: 'axis:command.fit',
    icon: IconArrowAutofitWidth,
    shortcut: 'Alt+Digit0',
    enabled: () => useRange.getState().view !== null,
    run: () => useRange.setState({ view: null }),
  },
];
