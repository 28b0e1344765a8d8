import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { show } from '../../../harness/testing';
import { LeftOut } from './LeftOut';

it('folds what is not looked at', () => {
  show(<LeftOut lines={[{ file: 'a/b.stl', line: null, text: 'a link is not followed' }]} />);
  expect(screen.getByText('1 thing in the files is not looked at')).toBeInTheDocument();
  expect(screen.getByText('a link is not followed')).not.toBeVisible();
});
