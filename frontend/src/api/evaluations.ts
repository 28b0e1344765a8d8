import type { components } from '@/generated/api';
import type { TestReport } from './types';
import { dataOf, done, rest, urlOf } from './http';

type Server = components['schemas'];
/** An evaluation of a revision of the project. */
export type Evaluation = Readonly<Server['Evaluation']>;
export type EvaluationSide = Readonly<Server['Side']>;
export type EvaluationList = Readonly<Server['EvaluationList']>;
/** The outcome of one run. */
export type Outcome = Readonly<Server['Outcome']>;
export type RunOutcome = Server['RunOutcome'];
export type Comparison = Readonly<Server['Comparison']>;
export type Replay = Readonly<Server['Replay']>;

const at = (project_id: string, evaluation_id: string) => ({ path: { project_id, evaluation_id } });

/** The calls for the evaluations of a project. */
export const evaluations = {
  list: (project_id: string, signal?: AbortSignal): Promise<EvaluationList> => {
    const params = { path: { project_id } };
    return dataOf(rest.GET('/api/v1/projects/{project_id}/evaluations', { params, signal: signal ?? null }));
  },
  start: (project_id: string, name: string, runs: number, sealed: boolean): Promise<Evaluation> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/evaluations', {
        params: { path: { project_id } },
        body: { name, runs, sealed },
      }),
    ),
  cancel: (projectId: string, id: string): Promise<Evaluation> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/cancel', {
        params: at(projectId, id),
      }),
    ),
  resume: (projectId: string, id: string): Promise<Evaluation> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/resume', {
        params: at(projectId, id),
      }),
    ),
  compare: (projectId: string, id: string, revision: number): Promise<Evaluation> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/compare', {
        params: at(projectId, id),
        body: { revision },
      }),
    ),
  remove: (projectId: string, id: string) =>
    done(
      rest.DELETE('/api/v1/projects/{project_id}/evaluations/{evaluation_id}', { params: at(projectId, id) }),
    ),
  outcomes: (projectId: string, id: string, revision: number, after: number, signal?: AbortSignal) =>
    dataOf(
      rest.GET('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/outcomes', {
        params: { ...at(projectId, id), query: { revision, after } },
        signal: signal ?? null,
      }),
    ),
  coverage: (projectId: string, id: string, revision: number): Promise<TestReport['coverage']> =>
    dataOf(
      rest.GET('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/coverage', {
        params: { ...at(projectId, id), query: { revision } },
      }),
    ),
  comparison: (projectId: string, id: string, signal?: AbortSignal): Promise<Comparison> =>
    dataOf(
      rest.GET('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/comparison', {
        params: at(projectId, id),
        signal: signal ?? null,
      }),
    ),
  askReplay: (projectId: string, id: string, revision: number, seed: number): Promise<Replay> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/replays', {
        params: at(projectId, id),
        body: { revision, seed },
      }),
    ),
  replay: (projectId: string, id: string, replay_id: string): Promise<Replay> =>
    dataOf(
      rest.GET('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/replays/{replay_id}', {
        params: { path: { ...at(projectId, id).path, replay_id } },
      }),
    ),
  cancelReplay: (projectId: string, id: string, replay_id: string) =>
    done(
      rest.DELETE('/api/v1/projects/{project_id}/evaluations/{evaluation_id}/replays/{replay_id}', {
        params: { path: { ...at(projectId, id).path, replay_id } },
      }),
    ),
  linesUrl: (projectId: string, id: string, revision: number) =>
    urlOf(`/projects/${projectId}/evaluations/${id}/runs.jsonl?revision=${revision}`),
  reportUrl: (projectId: string, id: string) => urlOf(`/projects/${projectId}/evaluations/${id}/report.html`),
};
