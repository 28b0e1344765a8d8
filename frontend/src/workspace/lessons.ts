import type { Model } from 'flexlayout-react';
import { create } from 'zustand';
import { lessonPath } from '@/model/lesson/find';
import { useProjectStore } from '@/store/project';
import type { PanelId } from './layoutModel';
import { showPanel } from './tabs';

const KEY = 'bts.lessons';
const LESSON: PanelId = 'lesson';
/** The number of projects that are remembered. In older projects, a closed lesson opens by itself again. */
const MOST_KEPT = 200;

interface Kept {
  /** Whether lessons open by themselves. */
  readonly opens: boolean;
  /** The projects whose lesson the user has closed. */
  readonly closed: readonly string[];
}

function kept(): Kept {
  try {
    const { opens, closed } = JSON.parse(localStorage.getItem(KEY) ?? '{}') as Partial<Kept>;
    const ids = Array.isArray(closed) ? closed.filter((id) => typeof id === 'string') : [];
    return { opens: opens !== false, closed: ids };
  } catch {
    return { opens: true, closed: [] };
  }
}

export const useLessons = create<Kept>(kept);

function keep(next: Partial<Kept>): void {
  useLessons.setState(next);
  const { opens, closed } = useLessons.getState();
  localStorage.setItem(KEY, JSON.stringify({ opens, closed: closed.slice(-MOST_KEPT) }));
}

/** Sets whether lessons open by themselves. */
export const setOpensLessons = (opens: boolean): void => keep({ opens });

/** Opens the lesson beside the inspector, where tree and code keep their width, or brings it to the front. */
export const showLesson = (): void => showPanel(LESSON);

/** Opens the lesson of a project, if it has one, unless the user closed it there or turned lessons off. */
export function openLesson(projectId: string): void {
  const { opens, closed } = useLessons.getState();
  const { files } = useProjectStore.getState();
  if (opens && !closed.includes(projectId) && lessonPath(Object.keys(files), 'en')) showLesson();
}

/** Stores whether the user has closed the lesson of a project. */
export function keepLesson(projectId: string, model: Model): void {
  const { closed, opens } = useLessons.getState();
  const isOpen = model.getNodeById(LESSON) !== undefined;
  const hasLesson = lessonPath(Object.keys(useProjectStore.getState().files), 'en') !== null;
  const others = closed.filter((id) => id !== projectId);
  if (isOpen) {
    if (others.length !== closed.length) keep({ closed: others });
  } else if (opens && hasLesson && others.length === closed.length) keep({ closed: [...others, projectId] });
}
