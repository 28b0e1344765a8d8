import type { TFunction } from 'i18next';
import { ApiError } from '@/api/errors';
import { reasonOf } from '@/api/reason';
import { reasonIn } from '@/model/evaluation/reasons';

type T = TFunction<'evaluate'>;

/** The refusals that have a text here, by their code. */
const REFUSALS = [
  'evaluation_runs',
  'no_evaluation',
  'not_found',
  'nothing_evaluated',
  'offline',
  'one_place',
  'outcomes_full',
  'project_archived',
  'report_failed',
  'revision_not_older',
  'role_too_low',
  'too_many_evaluations',
] as const;

/** Returns why a call failed, with what can be done about it. */
export function refusalText(t: T, error: Error): string {
  const code = error instanceof ApiError ? REFUSALS.find((each) => each === error.code) : undefined;
  return code === undefined ? reasonOf(error) : t(`refused.${code}`);
}

/** Returns a sentence about a run or an evaluation in the language of the page; others stay as they are. */
export function reasonText(t: T, sentence: string): string {
  const found = reasonIn(sentence);
  if (!found) return sentence;
  const { item, signal } = found.values;
  const values = item === undefined ? found.values : { item: reasonText(t, item) };
  // The report names the signal.
  const how = signal === 'SIGKILL' ? t('why.killed') : t('why.crashed');
  return t(`why.${found.key}`, { ...values, how });
}

/** Returns the lines of an evaluation's error, each as `reasonText`. */
export const linesText = (t: T, error: string): string =>
  error
    .split('\n')
    .map((line) => reasonText(t, line))
    .join('\n');
