import { t, translates } from '@/i18n';

interface Finding {
  readonly code: string;
  readonly message: string;
  readonly hint?: string | null | undefined;
  readonly values?: Readonly<Record<string, string>> | undefined;
}

/**
 * The words of a finding of the server: in the language of the page where `findings` has them, by the
 * finding's code, else as they came, in English. `near` is a name that was meant, where one is alike.
 */
export function findingText({ code, message, hint, values }: Finding): { message: string; hint: string } {
  const say = (part: 'message' | 'hint', given: string): string => {
    const key = `findings:${code}.${part}`;
    const filled = { replace: { ...values }, ...(values?.['near'] ? { context: 'near' } : {}) };
    return given !== '' && values && translates(key) ? t(key, filled) : given;
  };
  return { message: say('message', message), hint: say('hint', hint ?? '') };
}
