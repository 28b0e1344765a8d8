import {
  IconAdjustments,
  IconArrowLeftToArc,
  IconArrowRightToArc,
  IconBook2,
  IconCamera,
  IconCode,
  IconDeviceFloppy,
  IconDownload,
  IconExternalLink,
  IconFileImport,
  IconGitFork,
  IconHistory,
  IconHome,
  IconKeyboard,
  IconLayout,
  IconLayoutDashboard,
  IconLayoutSidebar,
  IconMapPin,
  IconMapPinOff,
  IconPlus,
  IconPresentation,
  IconTerminal2,
  IconWorld,
  IconRobot,
  IconSettings,
  IconWorldPlus,
  IconAlertTriangle,
} from '@tabler/icons-react';
import { everywhere } from '@/commands/global';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { navigate } from '@/store/route';
import { saveNow } from '@/store/saving/autosave';
import { openNewFile } from '@/store/dialogs/files';
import { openExportDialog } from '@/store/dialogs/export';
import { openShortcuts } from '@/store/dialogs/shortcuts';
import { openSettings } from '@/store/dialogs/settings';
import { openUniverseChooser } from '@/store/dialogs/universeChooser';
import { openImporting } from '@/store/dialogs/importing';
import { openNewRobot } from '@/store/dialogs/newRobot';
import { openNewUniverse } from '@/store/dialogs/newUniverse';
import { resetLayout, toggleViewMode } from './Dock';
import { fileCommands } from '@/features/explorer/fileCommands';
import { endGuide, startGuide, useGuide } from '@/features/onboarding/guide/guide';
import { usedCommands } from '@/features/explorer/used/commands';
import { focusInspector } from '@/workspace/focus';
import { openAnotherCamera } from '@/workspace/cameraViews';
import { WINDOWED, type PanelId } from '@/workspace/layoutModel';
import { popOut } from './popouts';
import { showLesson } from '@/workspace/lessons';
import { focusPanel } from '@/workspace/panelFocus';
import { present, togglePresentation } from '@/workspace/presentation';
import { openTab, showPanel, togglePanel, useTabs } from '@/workspace/tabs';

/** Moves the keyboard focus to the tree that was edited last. */
function goToTree(): void {
  const { activeTree, mainTree } = useProjectStore.getState();
  openTab({ kind: 'tree', id: activeTree ?? mainTree });
}

/** Moves the keyboard focus to a property of the selected block: to the field of a port, or to the first one. */
export function goToInspector(port?: string): void {
  if (port !== undefined && !useTabs.getState().model?.getNodeById('inspector')) togglePanel('inspector');
  showPanel('inspector');
  // A menu or a box that closes returns the focus first.
  setTimeout(() => focusInspector(port));
}

/** Moves the focus from a field of the inspector back to its block when Escape is pressed. */
export function leaveInspector(event: KeyboardEvent): void {
  const { target } = event;
  if (event.key !== 'Escape' || event.defaultPrevented || !(target instanceof HTMLElement)) return;
  if (!target.closest('[data-testid="inspector"]') || target.getAttribute('aria-expanded') === 'true') return;
  goToTree();
}

const rows: UserCommand[] = [
  {
    id: 'project.save',
    group: 'project',
    labelKey: 'frame:command.save',
    icon: IconDeviceFloppy,
    shortcut: '$mod+KeyS',
    inTextFields: true,
    run: () => void saveNow().catch(() => undefined),
  },
  {
    id: 'project.newAction',
    group: 'project',
    labelKey: 'frame:command.newAction',
    icon: IconPlus,
    run: () => openNewFile('action'),
  },
  {
    id: 'project.newTree',
    group: 'project',
    labelKey: 'frame:command.newTree',
    icon: IconPlus,
    run: () => openNewFile('tree'),
  },
  {
    id: 'project.newFile',
    group: 'project',
    labelKey: 'frame:explorer.new.file',
    icon: IconPlus,
    run: () => openNewFile('file'),
  },
  {
    id: 'project.takeAway',
    group: 'project',
    labelKey: 'frame:command.takeAway',
    icon: IconDownload,
    shortcut: '$mod+Shift+KeyS',
    inTextFields: true,
    run: openExportDialog,
  },
  {
    id: 'project.newUniverse',
    group: 'project',
    labelKey: 'frame:command.newUniverse',
    icon: IconWorldPlus,
    run: () => openNewUniverse(),
  },
  {
    id: 'project.newRobot',
    group: 'project',
    labelKey: 'frame:command.newRobot',
    icon: IconRobot,
    run: () => openNewRobot(),
  },
  {
    id: 'project.import',
    group: 'project',
    labelKey: 'frame:command.importPart',
    icon: IconFileImport,
    enabled: () => useProjectStore.getState().role !== 'viewer',
    run: () => openImporting(),
  },
  {
    id: 'project.settings',
    group: 'project',
    labelKey: 'frame:command.settings',
    icon: IconSettings,
    shortcut: '$mod+Comma',
    inTextFields: true,
    run: openSettings,
  },
  {
    id: 'project.worlds',
    group: 'project',
    labelKey: 'frame:command.worlds',
    icon: IconWorld,
    shortcut: '$mod+Shift+KeyU',
    inTextFields: true,
    run: openUniverseChooser,
  },
  {
    id: 'project.home',
    group: 'go',
    labelKey: 'frame:command.home',
    icon: IconHome,
    run: () => navigate('/'),
  },
  {
    id: 'go.tree',
    group: 'go',
    labelKey: 'frame:command.goToTree',
    icon: IconGitFork,
    shortcut: 'Alt+KeyT',
    inTextFields: true,
    run: goToTree,
  },
  {
    id: 'go.nextPanel',
    group: 'go',
    labelKey: 'frame:command.nextPanel',
    icon: IconArrowRightToArc,
    shortcut: '$mod+F6',
    inTextFields: true,
    run: (page) => void focusPanel(1, page),
  },
  {
    id: 'go.previousPanel',
    group: 'go',
    labelKey: 'frame:command.previousPanel',
    icon: IconArrowLeftToArc,
    shortcut: '$mod+Shift+F6',
    inTextFields: true,
    run: (page) => void focusPanel(-1, page),
  },
  {
    id: 'go.inspector',
    group: 'go',
    labelKey: 'frame:command.goToInspector',
    icon: IconAdjustments,
    shortcut: 'F4',
    inTextFields: true,
    enabled: () => useProjectStore.getState().selection.length > 0,
    run: () => goToInspector(),
  },
  {
    id: 'view.console',
    group: 'view',
    labelKey: 'frame:command.showConsole',
    icon: IconTerminal2,
    shortcut: '$mod+Backquote',
    inTextFields: true,
    run: () => showPanel('console'),
  },
  {
    id: 'view.problems',
    group: 'view',
    labelKey: 'frame:command.showProblems',
    icon: IconAlertTriangle,
    shortcut: '$mod+Shift+KeyM',
    inTextFields: true,
    run: () => showPanel('problems'),
  },
  {
    id: 'view.history',
    group: 'view',
    labelKey: 'frame:command.history',
    icon: IconHistory,
    shortcut: '$mod+Shift+KeyH',
    inTextFields: true,
    run: () => showPanel('history'),
  },
  {
    id: 'view.xml',
    group: 'view',
    labelKey: 'frame:command.xml',
    icon: IconCode,
    shortcut: '$mod+Shift+KeyX',
    inTextFields: true,
    run: () => togglePanel('xml'),
  },
  {
    id: 'view.lesson',
    group: 'view',
    labelKey: 'frame:command.lesson',
    icon: IconBook2,
    run: showLesson,
  },
  {
    id: 'view.shortcuts',
    group: 'view',
    labelKey: 'frame:command.shortcuts',
    icon: IconKeyboard,
    shortcut: '$mod+Slash',
    inTextFields: true,
    run: openShortcuts,
  },
  {
    id: 'view.guide',
    group: 'view',
    labelKey: 'onboarding:guide.start',
    icon: IconMapPin,
    enabled: () => useProjectStore.getState().role !== 'viewer',
    run: startGuide,
  },
  {
    id: 'view.endGuide',
    group: 'view',
    labelKey: 'onboarding:guide.skip',
    icon: IconMapPinOff,
    enabled: () => useGuide.getState().step !== null,
    run: endGuide,
  },
  {
    id: 'view.present',
    group: 'view',
    labelKey: 'frame:command.present',
    icon: IconPresentation,
    shortcut: 'Alt+KeyP',
    inTextFields: true,
    run: togglePresentation,
  },
  {
    id: 'view.presentRobot',
    group: 'view',
    labelKey: 'frame:command.presentRobot',
    icon: IconPresentation,
    run: () => present('robot'),
  },
  {
    id: 'view.anotherCamera',
    group: 'view',
    labelKey: 'frame:command.anotherCamera',
    icon: IconCamera,
    run: openAnotherCamera,
  },
  {
    id: 'view.mode',
    group: 'view',
    labelKey: 'frame:command.viewMode',
    icon: IconLayoutDashboard,
    run: toggleViewMode,
  },
  {
    id: 'view.resetLayout',
    group: 'view',
    labelKey: 'frame:command.resetLayout',
    icon: IconLayout,
    run: resetLayout,
  },
];

/** The panels that get a command to open them; the other panels have commands of their own. */
const PANELS: readonly PanelId[] = [
  'explorer',
  'outline',
  'palette',
  'library',
  'inspector',
  'blackboard',
  'viewer3d',
  'video',
  'camera',
  'tests',
  'evaluate',
  'timeline',
  'topics',
  'breakpoints',
  'profile',
];

/** The keys of panels that are hidden until they are used. */
const KEYS: Partial<Record<PanelId, Pick<UserCommand, 'shortcut' | 'inTextFields'>>> = {
  breakpoints: { shortcut: '$mod+Alt+KeyB', inTextFields: true },
  profile: { shortcut: '$mod+Alt+KeyP', inTextFields: true },
};

const panels = PANELS.map((id): UserCommand => ({
  id: `panel.${id}`,
  group: 'view',
  labelKey: `frame:panel.${id}`,
  icon: IconLayoutSidebar,
  ...KEYS[id],
  run: () => showPanel(id),
}));

const windows = WINDOWED.map((id): UserCommand => ({
  id: `view.popOut.${id}`,
  group: 'view',
  labelKey: `frame:ownWindow.${id}`,
  icon: IconExternalLink,
  run: () => popOut(id),
}));

export const registerFrameCommands = () =>
  registerCommands([...everywhere, ...rows, ...fileCommands, ...usedCommands, ...panels, ...windows]);
