import { TabNode } from 'flexlayout-react';
import { create } from 'zustand';
import { useProjectStore } from '@/store/project';
import type { PanelId } from './layoutModel';
import { documentOf, isInFront, openTab, showPanel, useTabs } from './tabs';

/** The content of the presentation: `off` if there is none, the tree, or the tree and the robot's view. */
export type PresentationMode = 'off' | 'tree' | 'robot';

interface Presentation {
  readonly mode: PresentationMode;
  /** The panel that shows the robot. */
  readonly view: PanelId;
  /** Whether the presentation itself requested the full screen, which then ends with it. */
  readonly isFull: boolean;
}

export const usePresentation = create<Presentation>(() => ({ mode: 'off', view: 'viewer3d', isFull: false }));

const VIEWS: readonly PanelId[] = ['viewer3d', 'video', 'camera'];

/** Returns the view in front, otherwise the first one that is not in a window of its own. */
function viewInFront(): PanelId | null {
  const { model, inWindows } = useTabs.getState();
  const here = VIEWS.filter((id) => model?.getNodeById(id) && !inWindows.includes(id));
  const seen = here.find((id) => {
    const node = model?.getNodeById(id);
    return node instanceof TabNode && node.isVisible();
  });
  return seen ?? here[0] ?? null;
}

/** Shows only the tree, or the tree and the robot. The tree that was last in front comes to the front. */
export function present(mode: 'tree' | 'robot'): void {
  const { front } = useTabs.getState();
  const { activeTree, mainTree } = useProjectStore.getState();
  if (usePresentation.getState().mode === 'off' || front?.kind !== 'file')
    openTab({ kind: 'tree', id: activeTree ?? mainTree });
  const view = mode === 'robot' ? viewInFront() : null;
  if (view !== null) showPanel(view);
  usePresentation.setState(view === null ? { mode: 'tree' } : { mode, view });
}

/** Shows everything again. */
export function endPresentation(): void {
  if (usePresentation.getState().mode === 'off') return;
  const { isFull } = usePresentation.getState();
  usePresentation.setState({ mode: 'off', isFull: false });
  if (isFull && document.fullscreenElement) void document.exitFullscreen();
}

export const togglePresentation = (): void =>
  usePresentation.getState().mode === 'off' ? present('tree') : endPresentation();

/** Shows or hides the robot beside the tree. */
export const toggleRobot = (): void =>
  present(usePresentation.getState().mode === 'robot' ? 'tree' : 'robot');

/** Enters or leaves the full screen. If the browser refuses, the window stays as it is. */
export async function toggleFullScreen(): Promise<void> {
  if (document.fullscreenElement) {
    // This comes first, so that leaving the full screen does not count as ending the presentation.
    usePresentation.setState({ isFull: false });
    return document.exitFullscreen();
  }
  await document.documentElement.requestFullscreen().then(
    () => usePresentation.setState({ isFull: true }),
    () => undefined,
  );
}

/** Returns the role of a tab in the presentation; null if the tab is hidden. */
export function roleOf(node: TabNode, { mode, view }: Presentation): 'tree' | 'robot' | null {
  if (mode === 'off') return null;
  if (documentOf(node)) return isInFront(node) ? 'tree' : null;
  return mode === 'robot' && node.getId() === view ? 'robot' : null;
}
