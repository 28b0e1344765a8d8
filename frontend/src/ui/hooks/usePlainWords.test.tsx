import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { basicPage } from '../../../harness/basicPage';
import { show } from '../../../harness/testing';
import { usePlainWords } from './usePlainWords';

function Question() {
  const t = usePlainWords('why');
  return (
    <p>
      {t('question.notTicked')} {t('question.result', { status: 'SUCCESS' })}
    </p>
  );
}

it('says *ticked* where everything is shown', () => {
  show(<Question />);
  expect(screen.getByText('Why was it not ticked? Why is it SUCCESS?')).toBeVisible();
});

it('has other words on the basic page, where there are such', () => {
  basicPage();
  show(<Question />);
  expect(screen.getByText('Why did it not run? Why is it SUCCESS?')).toBeVisible();
});

const texts = import.meta.glob<string>('../../i18n/locales/*/{why,run,debug,axis,code}.json', {
  eager: true,
  query: '?raw',
  import: 'default',
});

it.each(Object.entries(texts))('has no plain text with the word it avoids: %s', (_, text) => {
  expect(text.match(/_basic": ".*\btick.*"/gi)).toBeNull();
});
