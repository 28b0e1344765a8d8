import type { TFunction } from 'i18next';
import { useTranslation } from 'react-i18next';
import { t as translate } from '@/i18n';
import type { ShownProblem, TopicProblem } from '@/store/project/problems';
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

const topicText = ({ code, values }: TopicProblem): ProblemText => ({
  message: translate(`problems:mismatch.${code}.message`, { replace: values }),
  hint: translate(`problems:mismatch.${code}.hint`, { replace: values }),
});

/** Returns a function for the text of a finding, of the editor's own checks or of the server's. */
export function useProblemText(): (problem: ShownProblem) => ProblemText {
  const { t } = useTranslation('editor');
  return (problem) => {
    if (problem.source === 'topic') return topicText(problem);
    return problem.source === 'server' ? findingText(problem) : ownText(problem, t);
  };
}
