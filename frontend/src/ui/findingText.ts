import { t, translates } from '@/i18n';

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
  const say = (part: 'message' | 'hint', given: string): string => {
    const key = `findings:${code}.${part}`;
    const filled = { replace: { ...values }, ...(values?.['near'] ? { context: 'near' } : {}) };
    return given !== '' && values && translates(key) ? t(key, filled) : given;
  };
  return { message: say('message', message), hint: say('hint', hint ?? '') };
}
