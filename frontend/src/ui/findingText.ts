import { t, translates } from '@/i18n';
import { typeWords } from '@/i18n/typeWords';

interface Finding {
  readonly code: string;
  readonly message: string;
  readonly hint?: string | null | undefined;
  readonly values?: Readonly<Record<string, string>> | undefined;
}

/**
 * Returns the texts of a server finding: translated if `findings` has its code, otherwise the English ones.
 * `near` is a similar name, if there is one.
 */
export function findingText({ code, message, hint, values }: Finding): { message: string; hint: string } {
  const { value_type: type, other_type: other } = values ?? {};
  const inWords = {
    ...(type !== undefined && { held: typeWords(type) }),
    ...(other !== undefined && { other_held: typeWords(other) }),
  };
  const say = (part: 'message' | 'hint', given: string): string => {
    const key = `findings:${code}.${part}`;
    const filled = { replace: { ...values, ...inWords }, ...(values?.['near'] ? { context: 'near' } : {}) };
    return given !== '' && values && translates(key) ? t(key, filled) : given;
  };
  return { message: say('message', message), hint: say('hint', hint ?? '') };
}
