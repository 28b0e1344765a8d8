import i18next from 'i18next';
import { initReactI18next } from 'react-i18next';

/**
 * The texts: one JSON file for each feature and language, `locales/<language>/<feature>.json`; the feature is
 * the namespace. The start page loads these texts; the editor adds its own (`editorTexts`).
 */
const files = import.meta.glob<Record<string, unknown>>(
  './locales/*/{accounts,attached,editor,frame,projects,runs,settings}.json',
  { eager: true, import: 'default' },
);

export const LANGUAGES = { en: 'English', es: 'Español' } as const;
export type Language = keyof typeof LANGUAGES;

const STORAGE_KEY = 'bts.language';

export function resourcesFrom(modules: Record<string, Record<string, unknown>>) {
  const resources: Record<string, Record<string, Record<string, unknown>>> = {};
  for (const [path, texts] of Object.entries(modules)) {
    const [language = '', file = ''] = path.split('/').slice(-2);
    (resources[language] ??= {})[file.replace('.json', '')] = texts;
  }
  return resources;
}

function firstLanguage(): Language {
  const wanted = localStorage.getItem(STORAGE_KEY) ?? navigator.language;
  return wanted.startsWith('es') ? 'es' : 'en';
}

void i18next.use(initReactI18next).init({
  resources: resourcesFrom(files),
  lng: firstLanguage(),
  fallbackLng: 'en',
  defaultNS: 'frame',
  interpolation: { escapeValue: false },
  initAsync: false,
});
document.documentElement.lang = i18next.language;

export function setLanguage(language: Language): void {
  localStorage.setItem(STORAGE_KEY, language);
  void i18next.changeLanguage(language);
  // Observers of this attribute then find the new texts.
  document.documentElement.lang = language;
}

export function currentLanguage(): Language {
  return i18next.language.startsWith('es') ? 'es' : 'en';
}

export const t = i18next.t.bind(i18next);

/** Returns whether the current language has a text for a key. */
export const translates = (key: string): boolean => i18next.exists(key);
