import {
  IconArrowBarToRight,
  IconChevronLeft,
  IconChevronLeftPipe,
  IconChevronRight,
  IconChevronRightPipe,
  IconLink,
  IconPlayerPlay,
  IconArrowBackUp,
  IconArrowForwardUp,
  IconGitBranch,
  IconArrowsSplit2,
  IconGitCompare,
  IconX,
  IconCode,
} from '@tabler/icons-react';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { t } from '@/i18n';
import { linkTo, shownAddress } from '@/store/moment/address';
import { canChangeBranch, changeBranch } from '@/store/dialogs/branches';
import { canCompare, compareSomething, endComparing, isComparing } from '@/store/moment/compare/comparing';
import { canGoBack, canRunOn, goBack, runOn } from '@/store/moment/rerun/goBack';
import { extent, goTicks, goToChange, lookNow, setPlaying } from '@/store/moment/looking';
import { askTries, canTry } from '@/store/moment/rerun/tryMany';
import { usePastTree } from '@/store/moment/pastTree';
import { canShowSource, showSource } from '@/store/moment/rerun/sourceOfTick';
import { isLookingBack, useMoment } from '@/store/moment/store';
import { useSource } from '@/store/moment/source';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { markCommands } from './markCommands';
import { rangeCommands } from './rangeCommands';
import { copyLink } from '@/ui/copying';
import { bringToFront } from '@/workspace/tabs';

const hasRecording = () => extent() !== null;

/** Returns the number of the selected block in the shown tree. */
export function selectedUid(): number | null {
  const { activeTree, selection } = useProjectStore.getState();
  const nodes = isLookingBack() ? useMoment.getState().tree : useSessionStore.getState().tree;
  // The tree as it ran may have blocks that the present one has not.
  const past = usePastTree.getState();
  const id = selection[0] ?? (isLookingBack() ? past.node : null);
  const tree = selection.length > 0 ? activeTree : past.tree;
  return nodes.find((node) => node.tree_id === tree && node.node_id === id)?.uid ?? null;
}

function toChange(direction: 1 | -1): void {
  const uid = selectedUid();
  if (uid !== null) void goToChange(uid, direction);
}

const rows: readonly UserCommand[] = [
  {
    id: 'time.live',
    group: 'run',
    labelKey: 'axis:command.live',
    icon: IconArrowBarToRight,
    shortcut: 'Escape',
    enabled: isLookingBack,
    run: lookNow,
  },
  {
    id: 'time.goBack',
    group: 'run',
    labelKey: 'axis:command.goBack',
    icon: IconArrowBackUp,
    shortcut: 'Alt+KeyB',
    enabled: canGoBack,
    run: () => void goBack(),
  },
  {
    id: 'time.runOn',
    group: 'run',
    labelKey: 'axis:command.runOn',
    icon: IconArrowForwardUp,
    shortcut: 'Alt+Shift+KeyB',
    enabled: canRunOn,
    run: () => void runOn(),
  },
  {
    id: 'time.tryMany',
    group: 'run',
    labelKey: 'axis:command.tryMany',
    icon: IconArrowsSplit2,
    shortcut: 'Alt+KeyY',
    enabled: canTry,
    run: () => askTries(selectedUid()),
  },
  {
    id: 'time.source',
    group: 'run',
    labelKey: 'axis:command.source',
    icon: IconCode,
    shortcut: 'Alt+KeyJ',
    enabled: canShowSource,
    run: () => {
      bringToFront({ kind: 'past' });
      showSource();
    },
  },
  {
    id: 'time.branch',
    group: 'run',
    labelKey: 'axis:command.branch',
    icon: IconGitBranch,
    enabled: canChangeBranch,
    run: changeBranch,
  },
  {
    id: 'time.compare',
    group: 'run',
    labelKey: 'axis:command.compare',
    icon: IconGitCompare,
    shortcut: 'Alt+KeyO',
    enabled: canCompare,
    run: compareSomething,
  },
  {
    id: 'time.compareEnd',
    group: 'run',
    labelKey: 'axis:command.compareEnd',
    icon: IconX,
    shortcut: 'Escape',
    when: 'compared',
    enabled: isComparing,
    run: endComparing,
  },
  {
    id: 'time.play',
    group: 'run',
    labelKey: 'axis:command.play',
    icon: IconPlayerPlay,
    enabled: hasRecording,
    run: () => setPlaying(!useMoment.getState().isPlaying),
  },
  {
    id: 'time.tickBack',
    group: 'run',
    labelKey: 'axis:command.tickBack',
    icon: IconChevronLeft,
    shortcut: 'Alt+Comma',
    enabled: hasRecording,
    run: () => void goTicks(-1),
  },
  {
    id: 'time.tickForth',
    group: 'run',
    labelKey: 'axis:command.tickForth',
    icon: IconChevronRight,
    shortcut: 'Alt+Period',
    enabled: hasRecording,
    run: () => void goTicks(1),
  },
  {
    id: 'time.changeBack',
    group: 'run',
    labelKey: 'axis:command.changeBack',
    icon: IconChevronLeftPipe,
    shortcut: 'Alt+Shift+Comma',
    enabled: () => hasRecording() && selectedUid() !== null,
    run: () => toChange(-1),
  },
  {
    id: 'time.changeForth',
    group: 'run',
    labelKey: 'axis:command.changeForth',
    icon: IconChevronRightPipe,
    shortcut: 'Alt+Shift+Period',
    enabled: () => hasRecording() && selectedUid() !== null,
    run: () => toChange(1),
  },
  {
    id: 'time.copyLink',
    group: 'run',
    labelKey: 'axis:command.copyLink',
    icon: IconLink,
    enabled: isLookingBack,
    run: copyShownLink,
  },
];

/** Copies the link to the shown moment, and shows who can open it. */
export function copyShownLink(): void {
  const shown = shownAddress();
  const { projectId } = useProjectStore.getState();
  if (!shown || projectId === null) return;
  const { kept } = useSource.getState();
  const at = (shown.t ?? 0).toFixed(2);
  const note = kept ? t('axis:link.ofKept', { name: kept.name, t: at }) : t('axis:link.ofSession');
  void copyLink(linkTo(projectId, shown), note);
}

export const registerAxisCommands = () => registerCommands([...rows, ...rangeCommands, ...markCommands]);
