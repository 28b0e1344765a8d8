import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { setLanguage } from '@/i18n';
import { show, user } from '../../../harness/testing';
import { LanguageMenu } from './LanguageMenu';

it('changes the language of the page', async () => {
  onTestFinished(() => {
    setLanguage('en');
    localStorage.clear();
  });
  show(<LanguageMenu />);
  await user.click(screen.getByRole('button', { name: 'Language' }));
  const items = screen.getAllByRole('menuitem');
  expect(items.map((item) => [item.textContent, item.lang])).toEqual([
    ['English', 'en'],
    ['Español', 'es'],
  ]);
  await act(async () => user.click(screen.getByRole('menuitem', { name: 'Español' })));
  expect(screen.getByRole('button', { name: 'Idioma' })).toBeInTheDocument();
  expect(document.documentElement.lang).toBe('es');
  expect(localStorage.getItem('bts.language')).toBe('es');
});
