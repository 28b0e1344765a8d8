import type { RunTime } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { endSession, send } from '@/store/session/connection';
import { isCancelled, isUnconnected } from '@/store/session/control';
import { doesWorldRunAlone, isWorldPaused } from '@/store/session/clock';
import { useSessionStore } from '@/store/session/store';
import { useRunStore } from './store';

/** Reports the error of a refused command in the banner. */
export async function reported(doing: Promise<unknown>): Promise<void> {
  try {
    await doing;
  } catch (error) {
    if (isUnconnected(error) || isCancelled(error)) return;
    const message = error instanceof Error ? error.message : String(error);
    const hint = error instanceof Error && 'hint' in error ? String(error.hint) : '';
    useRunStore.setState({
      failure: { stage: 'launching', code: 'command_refused', message, hint, diagnostics: [] },
    });
  }
}

export const isRunning = () => useSessionStore.getState().executor === 'application_running';
export const isPaused = () => useSessionStore.getState().executor === 'paused';
export const isHeld = () => useSessionStore.getState().executor === 'held';
export const hasApplication = () => isRunning() || isPaused() || isHeld();
const isGoingBack = () => useSessionStore.getState().goingBack !== null;
export const canResume = () => isPaused() && !isGoingBack();
export const canStep = () => (isRunning() || isPaused()) && !isGoingBack();
/** Returns whether the program can be restarted in the running world. */
export const canRestart = () =>
  hasApplication() || useSessionStore.getState().executor === 'visualization_ready';
const isWorldUp = () => !['idle', 'connected'].includes(useSessionStore.getState().executor);
export const isViewer = () => useSessionStore.getState().introspection?.role === 'viewer';
export const hasSession = () => useSessionStore.getState().connection !== 'off';

/** The steps that are under way. The session refuses most commands meanwhile, so those that follow wait. */
let steps: Promise<unknown> = Promise.resolve();

/** Steps after the steps that are under way. */
export function afterSteps(doing: () => Promise<unknown>): Promise<unknown> {
  const done = steps.then(doing);
  steps = done.catch(() => undefined);
  return done;
}

export const pause = () => reported(send('pause', {}));
/** Runs on, after the steps that are under way. */
export const resume = () => reported(steps.then(() => send('resume', {})));
export const stop = () => reported(send('terminate_application', {}));
/** Lets the world run without a program. */
export const runWorld = () =>
  reported(
    send('run_world', {}).then(() =>
      useSessionStore.setState(({ sim }) => (sim ? { sim: { ...sim, paused: false } } : {})),
    ),
  );
export const canRunWorld = () => {
  const session = useSessionStore.getState();
  return session.executor === 'visualization_ready' && isWorldPaused(session);
};
/** Returns whether something can be stopped: a program, or a world that runs without one. */
export const canStop = () => hasApplication() || doesWorldRunAlone(useSessionStore.getState());
export const resetWorld = () => reported(send('reset_world', {}));
/** Takes control of the session; the page that had it becomes a viewer. */
export const takeOver = () => reported(send('take_over', {}));
export const end = () => reported(endSession());

/** Runs one tick; a running application is paused first. */
export const step = () => stepMany(1);

/** Runs several ticks one after the other, until one is refused or the program has ended. */
export const stepMany = (count: number) =>
  reported(
    afterSteps(async () => {
      if (isRunning()) await send('pause', {});
      for (let i = 0; i < count && (i === 0 || isPaused()); i++) await send('step', {});
    }),
  );

/** Sets the tick rate in the project, and in the running application. */
export function setTickRate(tickHz: number): void {
  const isSame = useRunStore.getState().ranAt === useProjectStore.getState().changeCounter;
  useProjectStore.getState().setSettings({ tick_hz: tickHz });
  useSessionStore.setState({ tickHz });
  if (!isRunning() && !isPaused()) return;
  // The running application has the new rate too, so this change does not make the program outdated.
  if (isSame) useRunStore.setState({ ranAt: useProjectStore.getState().changeCounter });
  void reported(send('set_tick_rate', { tick_hz: tickHz }));
}

/** Sets whether time waits for the tree, in the project's runs from the next one on. */
export function setRunTime(time: RunTime): void {
  useProjectStore.getState().setSettings({ time });
}

/**
 * Sets the ratio of simulated to real time; 0 means as fast as possible. The next world starts with the same
 * ratio.
 */
export function setSpeed(speed: number): void {
  useSessionStore.setState({ speed });
  if (isWorldUp()) void reported(send('set_speed', { speed }));
}
