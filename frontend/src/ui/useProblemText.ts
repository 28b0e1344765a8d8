import type { TFunction } from 'i18next';
import { useTranslation } from 'react-i18next';
import type { ShownProblem } from '@/store/project/problems';
import { findingText } from './findingText';
import { scriptText } from './scriptText';

export interface ProblemText {
  readonly message: string;
  readonly hint: string;
}

function ownText(problem: ShownProblem & { source: 'editor' }, t: TFunction<'editor'>): ProblemText {
  const script = problem.script && scriptText(problem.script, t);
  const values = { ...problem.values, ...(script && { problem: script.message, advice: script.hint }) };
  return {
    message: t(`problem.${problem.kind}.message`, values),
    hint: t(`problem.${problem.kind}.hint`, values),
  };
}

/** Returns a function that gives the text of a finding, of the editor's own checks or of the server's. */
export function useProblemText(): (problem: ShownProblem) => ProblemText {
  const { t } = useTranslation('editor');
  return (problem) => (problem.source === 'server' ? findingText(problem) : ownText(problem, t));
}
