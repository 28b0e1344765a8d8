import i18next from 'i18next';
import { expect, it } from 'vitest';
import '@/i18n';
import { revision } from '../../../harness/requests';
import { sayRevision } from './words';

it.each([
  ['Edit 5 files', 'Edited 5 files'],
  ['Edit MainTree.json, Go.py', 'Edited MainTree, Go.py'],
  ['Create the project', 'Project made'],
  ['Import', 'Imported'],
  ['Duplicate of Bump and go', 'Copy of Bump and go'],
  ['Restore revision 12', 'Revision 12 restored'],
  ['Rename the project', 'Project renamed'],
  ['Change the settings', 'Settings changed'],
  ['Import of a friend', 'Import of a friend'],
  ['My own words', 'My own words'],
  ['', 'Revision 7'],
])('translates “%s” to “%s”', (message, words) => {
  const say = i18next.getFixedT('en', 'revisions');
  expect(sayRevision(revision(7, { message }), say)).toBe(words);
});
