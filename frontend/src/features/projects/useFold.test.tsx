import { act, renderHook, waitFor } from '@testing-library/react';
import { QueryClientProvider } from '@tanstack/react-query';
import type { ReactNode } from 'react';
import { beforeEach, expect, it } from 'vitest';
import { queries } from '@/api/queries';
import { summary } from '../../../harness/requests';
import { fakeServer } from '../../../harness/testing';
import { useFold } from './useFold';

const LIST = 'GET /projects?search=&sort=-updated_at&shelf=current&offset=0&limit=48';
const wrapper = ({ children }: { readonly children: ReactNode }) => (
  <QueryClientProvider client={queries}>{children}</QueryClientProvider>
);
const open = () => renderHook(() => useFold(), { wrapper }).result;

beforeEach(() => {
  localStorage.clear();
  queries.clear();
});

it('is folded as at the last visit, until the server has answered', async () => {
  fakeServer({ [LIST]: { items: [], total: 0, next_offset: null } });
  localStorage.setItem('bts.start.folded', 'true');
  const fold = open();
  expect(fold.current.isFolded).toBe(true);
  await waitFor(() => expect(fold.current.isFolded).toBe(false));
  expect(localStorage.getItem('bts.start.folded')).toBe('false');
});

it('stays as the user leaves it', async () => {
  fakeServer({ [LIST]: { items: [summary('a')], total: 1, next_offset: null } });
  const fold = open();
  await waitFor(() => expect(fold.current.isFolded).toBe(true));
  act(() => fold.current.toggle());
  expect(fold.current.isFolded).toBe(false);
});
