import { useTranslation } from 'react-i18next';
import { t } from '@/i18n';
import { typeWords } from '@/i18n/typeWords';
import type { ShownProblem, TopicProblem } from '@/store/project/problems';
import { findingText } from '../findingText';
import { scriptText } from '../scriptText';

export interface ProblemText {
  readonly message: string;
  readonly hint: string;
}

function ownText({ kind, values: given, script: broken }: ShownProblem & { source: 'editor' }): ProblemText {
  const script = broken && scriptText(broken, t);
  const { valueType, otherType } = given;
  const values = {
    ...given,
    ...(valueType !== undefined && { wanted: typeWords(String(valueType)) }),
    ...(otherType !== undefined && { otherWanted: typeWords(String(otherType)) }),
    ...(script && { problem: script.message, advice: script.hint }),
  };
  return {
    message: t(`editor:problem.${kind}.message`, values),
    hint: t(`editor:problem.${kind}.hint`, values),
  };
}

const topicText = ({ code, values }: TopicProblem): ProblemText => ({
  message: t(`problems:mismatch.${code}.message`, { replace: values }),
  hint: t(`problems:mismatch.${code}.hint`, { replace: values }),
});

/** Returns the text of a finding, of the editor's own checks or of the server's. */
export function problemText(problem: ShownProblem): ProblemText {
  if (problem.source === 'topic') return topicText(problem);
  return problem.source === 'server' ? findingText(problem) : ownText(problem);
}

/** Returns the same function; the component is rendered again in another language. */
export function useProblemText(): (problem: ShownProblem) => ProblemText {
  useTranslation('editor');
  return problemText;
}
