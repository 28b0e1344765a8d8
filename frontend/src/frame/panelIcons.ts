import {
  IconAlertTriangle,
  IconApps,
  IconAdjustments,
  IconBook2,
  IconBroadcast,
  IconBug,
  IconCamera,
  IconChalkboard,
  IconChartDots,
  IconCode,
  IconCube,
  IconFlame,
  IconFolder,
  IconHistory,
  IconListTree,
  IconSchool,
  IconSearch,
  IconTerminal2,
  IconTestPipe,
  IconTimeline,
  IconVideo,
  type Icon,
} from '@tabler/icons-react';
import type { PanelId } from '@/workspace/layoutModel';

/** The icon that the tab of a panel shows if its name does not fit. */
export const PANEL_ICONS: Readonly<Record<PanelId, Icon>> = {
  explorer: IconFolder,
  outline: IconListTree,
  search: IconSearch,
  palette: IconApps,
  library: IconBook2,
  inspector: IconAdjustments,
  blackboard: IconChalkboard,
  viewer3d: IconCube,
  video: IconVideo,
  camera: IconCamera,
  console: IconTerminal2,
  problems: IconAlertTriangle,
  tests: IconTestPipe,
  evaluate: IconChartDots,
  timeline: IconTimeline,
  topics: IconBroadcast,
  breakpoints: IconBug,
  profile: IconFlame,
  history: IconHistory,
  lesson: IconSchool,
  xml: IconCode,
};

export const panelIcon = (id: string): Icon | undefined =>
  Object.hasOwn(PANEL_ICONS, id) ? PANEL_ICONS[id as PanelId] : undefined;
