import { Actions, TabNode, TabSetNode } from 'flexlayout-react';
import { useProjectStore } from '@/store/project';
import type { PanelId } from './layoutModel';
import { useTabs } from './tabs';

let isLessonActing = false;

/** Runs what a button of the lesson does: the lesson stays in front, since it says what was done. */
export function actForLesson<T>(act: () => T): T {
  isLessonActing = true;
  try {
    return act();
  } finally {
    isLessonActing = false;
  }
}

/** Brings one of two panels to the front of the tabs that they share, if the other is there now. */
function swap(from: PanelId, to: PanelId): void {
  const { model } = useTabs.getState();
  const next = model?.getNodeById(to);
  const set = next?.getParent();
  if (!(next instanceof TabNode && set instanceof TabSetNode)) return;
  if (set.getSelectedNode()?.getId() !== from) return;
  // Selecting the tab would make its set the active one, and another tree than the clicked one could get active.
  model?.doAction(Actions.updateNodeAttributes(set.getId(), { selected: set.getChildren().indexOf(next) }));
}

/**
 * Lets lesson and inspector take turns where they share a place: the inspector says nothing before a block is
 * selected. Returns the end of it.
 */
export function followSelection(): () => void {
  return useProjectStore.subscribe(({ projectId, activeTree, selection }, before) => {
    if (isLessonActing || projectId !== before.projectId) return;
    const isSame = activeTree === before.activeTree && selection.join() === before.selection.join();
    if (isSame) return;
    if (selection.length > 0) swap('lesson', 'inspector');
    else swap('inspector', 'lesson');
  });
}
