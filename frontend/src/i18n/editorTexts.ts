import i18next from 'i18next';
import { resourcesFrom } from '.';

const files = import.meta.glob<Record<string, unknown>>(
  ['./locales/*/*.json', '!./locales/*/{accounts,attached,editor,frame,projects,runs,settings}.json'],
  { eager: true, import: 'default' },
);

/**
 * The texts of an open project. They are loaded separately, since the first page would be a tenth larger with
 * them.
 */
export const editorTexts = resourcesFrom(files);

for (const [language, features] of Object.entries(editorTexts)) {
  for (const [feature, texts] of Object.entries(features)) {
    i18next.addResourceBundle(language, feature, texts);
  }
}
