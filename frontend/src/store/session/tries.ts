import { create } from 'zustand';
import type {
  ServerMessage,
  TryingEnded,
  TryingProgress,
  TryingStarted,
  TryOutcome,
} from '@/generated/messages';

/** A moment of a run. */
export interface TriedMoment {
  readonly run: string;
  readonly t: number;
}

/** A block and a port, at a moment of a run. */
export interface TriedPlace extends TriedMoment {
  readonly treeId: string;
  readonly nodeId: string;
  readonly path: string;
  readonly port: string;
}

/** A job of *Try many*, and what is known of it. */
export interface TriesJob {
  readonly id: string;
  readonly moment: TriedMoment;
  /** The port whose values are tried; null: seeds are. */
  readonly place: TriedPlace | null;
  /** Values of the port, or seeds. */
  readonly values: readonly string[];
  /** The numbers of the outcomes whose paths are not drawn in 3D. */
  readonly hidden: readonly number[];
  readonly stage: TryingProgress['stage'];
  readonly fraction: number;
  readonly started: TryingStarted | null;
  /** By index; 0 is the run as it is. */
  readonly outcomes: readonly TryOutcome[];
  readonly ended: TryingEnded | null;
}

/** The last job of this page; null before the first. */
export const useTries = create<{ readonly job: TriesJob | null }>(() => ({ job: null }));

export function beginJob(id: string, at: TriedMoment | TriedPlace, values: readonly string[]): void {
  const job: TriesJob = {
    id,
    moment: { run: at.run, t: at.t },
    place: 'port' in at ? at : null,
    values,
    hidden: [],
    stage: 'going_back',
    fraction: 0,
    started: null,
    outcomes: [],
    ended: null,
  };
  useTries.setState({ job });
}

/** Changes a job that still runs. */
export function changeJob(id: string, change: (job: TriesJob) => Partial<TriesJob>): void {
  const { job } = useTries.getState();
  if (job?.id === id && job.ended === null) useTries.setState({ job: { ...job, ...change(job) } });
}

/** Chooses whether the path of an outcome is drawn in 3D. */
export function choosePath(index: number, isShown: boolean): void {
  const { job } = useTries.getState();
  if (!job) return;
  const others = job.hidden.filter((each) => each !== index);
  useTries.setState({ job: { ...job, hidden: isShown ? others : [...others, index] } });
}

/** Ends the job of a session that is gone. */
export function loseJob(message: string): void {
  const { job } = useTries.getState();
  if (job) changeJob(job.id, () => ({ ended: { job: job.id, end: 'failed', message } }));
}

/** Takes an event of the session. */
export function feedTries({ command, data }: ServerMessage): void {
  switch (command) {
    case 'trying_started': {
      const started = data as TryingStarted;
      return changeJob(started.job, () => ({ started, stage: 'continuing', fraction: 0 }));
    }
    case 'trying_progress': {
      const { job, stage, fraction } = data as TryingProgress;
      return changeJob(job, () => ({ stage, fraction }));
    }
    case 'try_outcome': {
      const outcome = data as TryOutcome;
      return changeJob(outcome.job, ({ outcomes }) => ({
        outcomes: [...outcomes, outcome].sort((one, other) => one.index - other.index),
      }));
    }
    case 'trying_ended': {
      const ended = data as TryingEnded;
      return changeJob(ended.job, () => ({ ended }));
    }
    default:
  }
}
