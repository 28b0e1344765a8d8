import i18next from 'i18next';
import { expect, it } from 'vitest';
import { editorTexts } from './editorTexts';

it.each(['en', 'es'])('adds the texts of every feature in %s', (language) => {
  const files = Object.keys(import.meta.glob('./locales/*/*.json')).filter((path) =>
    path.includes(`/${language}/`),
  );
  const features = files.map((path) => path.replace(/.*\/|\.json$/g, ''));
  expect(features.length).toBeGreaterThan(20);
  expect(editorTexts[language]).not.toHaveProperty('projects');
  expect(features.filter((feature) => !i18next.hasResourceBundle(language, feature))).toEqual([]);
});
