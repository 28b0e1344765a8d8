import type { TFunction } from 'i18next';
import type { ScriptProblem } from '@/model/script';

/** Returns the message and the hint for a script's syntax error. */
export function scriptText({ kind, values }: ScriptProblem, t: TFunction): { message: string; hint: string } {
  return {
    message: t(`editor:script.${kind}.message`, values),
    hint: t(`editor:script.${kind}.hint`, values),
  };
}
