import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { TemplateCards } from './TemplateCards';

const onCreate = vi.fn();
const templates = [
  { id: 'empty', name: '', description: '' },
  { id: 'mine', name: 'My own', description: 'Mine.' },
].map((each) => ({ ...each, universe: '', root_diagram: null, conditions: [] }));
const open = (pending: string | null = null) =>
  show(<TemplateCards templates={templates} onCreate={onCreate} pending={pending} />);
const card = (id: string) => screen.getByTestId(`new-from-${id}`);

it('makes a project of a template', async () => {
  open();
  expect(card('empty')).toHaveTextContent(/^Empty projectA blank canvas/);
  await user.click(card('mine'));
  expect(onCreate).toHaveBeenCalledExactlyOnceWith('mine');
});

it('makes no other while one is being made', () => {
  open('empty');
  expect(card('mine')).toBeDisabled();
  expect(card('empty').querySelector('.mantine-Loader-root')).not.toBeNull();
  expect(card('mine').querySelector('.mantine-Loader-root')).toBeNull();
});
