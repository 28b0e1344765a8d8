import { EditorState, type Extension } from '@codemirror/state';
import { t } from '@/i18n';

/** Returns the texts of the editor's own panels in the current language; the keys are the English texts. */
export const phrases = (): Extension =>
  EditorState.phrases.of(t('code:phrases', { returnObjects: true }) as Record<string, string>);
