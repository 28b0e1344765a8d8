import { useTranslation } from 'react-i18next';
import type { ShownProblem } from '@/store/project/problems';

export interface ProblemText {
  readonly message: string;
  readonly hint: string;
}

/** The words of a finding: the editor's own are translated, the server's come as they are. */
export function useProblemText(): (problem: ShownProblem) => ProblemText {
  const { t } = useTranslation('editor');
  return (problem) =>
    problem.source === 'server'
      ? { message: problem.message, hint: problem.hint }
      : {
          message: t(`problem.${problem.kind}.message`, problem.values),
          hint: t(`problem.${problem.kind}.hint`, problem.values),
        };
}
