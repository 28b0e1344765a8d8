import { create } from 'zustand';
import { api } from '@/api/client';
import type { Diagnostic } from '@/api/types';
import { useProjectStore } from '@/store/project';
import type { ProjectData } from '@/store/project/state';
import { useSavingStore } from '@/store/saving/store';
import { useSessionStore } from '@/store/session/store';

/** The code of the note that a robot with macros is not looked at. A save looks at none. */
export const NOT_LOOKED_AT = 'BT0915';
/** The code of an error in such a robot. */
const BROKEN = 'BT0916';
const IDLE_WITHIN_MS = 1500;

interface RobotFindings {
  /** The versions of the robots' files that the findings are about; empty if there are none yet. */
  readonly key: string;
  /** Whether an executor was there when they were looked at. */
  readonly isRunning: boolean;
  readonly found: readonly Diagnostic[];
}

/** The findings in robots with macros, which run in the user's executor, and so only on request. */
export const useRobotFindings = create<RobotFindings>(() => ({ key: '', isRunning: false, found: [] }));

const keys = new WeakMap<ProjectData['files'], string>();

/** Returns a key that is equal for equal saved files of robots. */
function keyOf({ projectId, files }: ProjectData): string {
  let listed = keys.get(files);
  if (listed === undefined) {
    listed = Object.values(files)
      .filter(({ path }) => /^(robots|assets)\//.test(path))
      .map(({ path, revision }) => `${path}@${revision}`)
      .sort()
      .join('\n');
    keys.set(files, listed);
  }
  return `${projectId ?? ''}\n${listed}`;
}

/** Returns the findings in the robots with macros of the open project; null if nobody has looked at them. */
export function useLookedAt(): readonly Diagnostic[] | null {
  const key = useProjectStore(keyOf);
  return useRobotFindings((state) => (state.key === key ? state.found : null));
}

/** Returns a function that cancels the work. */
function whenIdle(work: () => void): () => void {
  if ('requestIdleCallback' in window) {
    const request = requestIdleCallback(work, { timeout: IDLE_WITHIN_MS });
    return () => cancelIdleCallback(request);
  }
  const timer = setTimeout(work, IDLE_WITHIN_MS);
  return () => clearTimeout(timer);
}

/** Returns what is to be looked at; null if it is known, or not saved, or no robot has macros. */
function due(): Pick<RobotFindings, 'key' | 'isRunning'> | null {
  const project = useProjectStore.getState();
  if (!project.diagnostics.some(({ code }) => code === NOT_LOOKED_AT)) return null;
  if (useSavingStore.getState().state.kind !== 'saved') return null;
  const key = keyOf(project);
  const isRunning = useSessionStore.getState().connection === 'open';
  const known = useRobotFindings.getState();
  const isKnown =
    known.key === key &&
    (known.isRunning || !isRunning || known.found.every(({ code }) => code !== NOT_LOOKED_AT));
  return isKnown ? null : { key, isRunning };
}

async function look(asked: Pick<RobotFindings, 'key' | 'isRunning'>, signal: AbortSignal): Promise<void> {
  const { projectId } = useProjectStore.getState();
  if (projectId === null) return;
  try {
    const { diagnostics } = await api.check(projectId, [], signal);
    const found = diagnostics.filter(({ code }) => code === NOT_LOOKED_AT || code === BROKEN);
    if (!signal.aborted) useRobotFindings.setState({ ...asked, found });
  } catch {
    // The note of the save stays; the next save requests them again.
  }
}

/**
 * Asks for the findings in robots with macros after each save that changes a robot, and again when an
 * executor starts, if none was there; returns a function that stops it.
 */
export function followRobots(): () => void {
  let current: string | null = null;
  let stop: (() => void) | null = null;
  const follow = () => {
    const asked = due();
    const name = asked && `${asked.key} ${asked.isRunning}`;
    if (name === current) return;
    current = name;
    stop?.();
    stop = null;
    if (!asked) return;
    const request = new AbortController();
    const cancel = whenIdle(() => void look(asked, request.signal));
    stop = () => {
      cancel();
      request.abort();
    };
  };
  const unfollow = [useProjectStore, useSavingStore, useSessionStore].map((store) => store.subscribe(follow));
  follow();
  return () => {
    unfollow.forEach((end) => end());
    stop?.();
  };
}
