import { IconFlagPlus, IconListDetails, IconPlayerTrackNext, IconPlayerTrackPrev } from '@tabler/icons-react';
import type { UserCommand } from '@/commands/registry';
import { canFlag, draftFlag, useFlags } from '@/store/moment/flags';
import { extent } from '@/store/moment/looking';
import { goToMark } from './marks';

const hasRecording = () => extent() !== null;

export const markCommands: readonly UserCommand[] = [
  {
    id: 'time.flag',
    group: 'run',
    labelKey: 'axis:command.flag',
    icon: IconFlagPlus,
    shortcut: 'Alt+KeyM',
    enabled: canFlag,
    run: draftFlag,
  },
  {
    id: 'time.marks',
    group: 'run',
    labelKey: 'axis:command.marks',
    icon: IconListDetails,
    shortcut: 'Alt+Shift+KeyM',
    enabled: hasRecording,
    run: () => useFlags.setState(({ isListed }) => ({ isListed: !isListed })),
  },
  {
    id: 'time.markBack',
    group: 'run',
    labelKey: 'axis:command.markBack',
    icon: IconPlayerTrackPrev,
    shortcut: 'Alt+Shift+BracketLeft',
    enabled: hasRecording,
    run: () => goToMark(-1),
  },
  {
    id: 'time.markForth',
    group: 'run',
    labelKey: 'axis:command.markForth',
    icon: IconPlayerTrackNext,
    shortcut: 'Alt+Shift+BracketRight',
    enabled: hasRecording,
    run: () => goToMark(1),
  },
];
