import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { AppBundle, Diagnostic } from '@/api/types';
import type { Commands } from '@/generated/messages';
import { serverReason } from '@/i18n/serverReason';
import { useProjectStore } from '@/store/project';
import { errorsOf } from '@/store/project/problems';
import { saveNow } from '@/store/saving/autosave';
import { abandonStart, ensureConnected, send } from '@/store/session/connection';
import { CommandError, isCancelled, isUnconnected } from '@/store/session/control';
import { useSessionStore } from '@/store/session/store';
import { agreesTo, nextPlan, type Exchange } from './apply';
import { beginProgram } from './livePorts';
import { useRunStore, type LaunchFailure, type LaunchStage } from './store';
import { chosenUniverse, useUniverseChoice } from './universeChoice';

/** Saves, checks, starts the missing processes, and runs; resolves to true if the application runs. */
export const runProject = () => launch((app) => send('run', runCommand(app)));

/** Saves, checks, and restarts the application with the new program; the world continues. */
export const restartProject = () => launch((app) => send('run_application', applicationOf(app)));

async function launch(begin: (app: AppBundle) => Promise<void>): Promise<boolean> {
  const { projectId } = useProjectStore.getState();
  if (!projectId || useRunStore.getState().stage) return false;
  useRunStore.setState({ stage: 'saving', failure: null });
  useSessionStore.setState({
    isLaunching: true,
    progress: null,
    queued: null,
    faults: [],
    finished: null,
    executorReason: '',
  });
  try {
    const app = await packed(projectId, () => beginAs());
    enter('starting');
    await ensureConnected(projectId);
    enter('launching');
    await begin(app);
    return true;
  } catch (error) {
    tell(error);
    return false;
  } finally {
    useRunStore.setState({ stage: null });
    useSessionStore.setState({ isLaunching: false, progress: null, queued: null });
  }
}

/** Saves and checks the project, and returns it as an application; `saved` is called after the save. */
async function packed(projectId: string, saved: () => void): Promise<AppBundle> {
  await saveNow();
  saved();
  enter('checking');
  const errors = errorsOf(useProjectStore.getState().diagnostics);
  if (errors.length > 0) throw new UnsoundError(errors);
  return api.app(projectId, useUniverseChoice.getState().universe);
}

/** Makes the project as it is now the program that runs. */
function beginAs({ changeCounter, diagrams } = useProjectStore.getState()): void {
  useRunStore.setState({ ranAt: changeCounter });
  beginProgram(diagrams);
}

/**
 * Replaces the running tree by the project as it is now; world and program continue. Asks before it halts
 * something that runs. Resolves to true if the tree was replaced.
 */
export const applyProject = () =>
  exchanged('apply', (app_zip_base64) => send('apply', { app_zip_base64, dry: false }));

/**
 * Lets a paused run continue with the project as it is now; asks before it halts something that runs.
 * `arrive` first takes the run to the moment from which it continues, once the project is known to be sound.
 * Resolves to true if it runs on.
 */
export const runOnProject = (arrive: () => Promise<void>) =>
  exchanged('runOn', (app_zip_base64) => send('run_on', { app_zip_base64 }), arrive);

/** Saves and checks the project, shows what it would do to the running tree, and makes the exchange. */
async function exchanged(
  name: Exchange,
  exchange: (app: string) => Promise<void>,
  arrive?: () => Promise<void>,
): Promise<boolean> {
  const { projectId } = useProjectStore.getState();
  if (!projectId || useRunStore.getState().stage) return false;
  useRunStore.setState({ stage: 'saving', failure: null });
  try {
    let program = useProjectStore.getState();
    const { app_zip_base64 } = await packed(projectId, () => (program = useProjectStore.getState()));
    enter('applying');
    await arrive?.();
    const planned = nextPlan();
    await send('apply', { app_zip_base64, dry: true });
    if (!(await agreesTo(await planned, name))) return false;
    enter('applying');
    await exchange(app_zip_base64);
    beginAs(program);
    return true;
  } catch (error) {
    tell(error, { isChange: true });
    return false;
  } finally {
    useRunStore.setState({ stage: null });
  }
}

/** Thrown when the last save has errors: the server would refuse the program. */
class UnsoundError extends Error {
  constructor(readonly diagnostics: Diagnostic[]) {
    super(diagnostics[0]?.message ?? '');
  }
}

export function cancelRun(): void {
  const isStarting = useRunStore.getState().stage === 'starting';
  void (isStarting ? abandonStart() : send('cancel', {})).catch(() => undefined);
}

function enter(stage: LaunchStage): void {
  useRunStore.setState({ stage });
}

function runCommand(app: AppBundle): Commands['run'] {
  const { speed } = useSessionStore.getState();
  useSessionStore.setState({ tickHz: app.tick_hz });
  return {
    universe: { ...chosenUniverse(app), speed, time: app.time },
    application: applicationOf(app),
  };
}

function applicationOf({
  app_zip_base64,
  tick_hz,
  on_finish,
  on_error,
  revision,
}: AppBundle): Commands['run_application'] {
  return { app_zip_base64, tick_hz, on_finish, on_error, revision };
}

/**
 * Shows an error. Without a connection none is shown: the session continues, and reports the result after the
 * page reconnects.
 */
function tell(error: unknown, what: Pick<LaunchFailure, 'isChange'> = {}): void {
  if (isUnconnected(error) || isCancelled(error)) return;
  useRunStore.setState({ failure: { ...failureOf(error), ...what } });
}

function failureOf(error: unknown): LaunchFailure {
  const stage = useRunStore.getState().stage ?? 'saving';
  if (error instanceof ApiError) {
    const { code, diagnostics } = error;
    return {
      stage,
      code,
      message: serverReason(error),
      hint: error.isRestarted ? '' : error.hint,
      diagnostics,
    };
  }
  if (error instanceof CommandError) {
    return { stage, code: error.code, message: error.message, hint: error.hint, diagnostics: [] };
  }
  if (error instanceof UnsoundError) {
    const { message, diagnostics } = error;
    return { stage, code: 'check_failed', message, hint: diagnostics[0]?.hint ?? '', diagnostics };
  }
  const message = error instanceof Error ? error.message : String(error);
  return { stage, code: 'unknown', message, hint: '', diagnostics: [] };
}
