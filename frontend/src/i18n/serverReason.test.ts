import { expect, it } from 'vitest';
import { ApiError } from '@/api/errors';
import { serverReason } from './serverReason';

const failed = (status: number, code: string) =>
  new ApiError({ title: 'No', status, code, detail: 'What the server says.' });

it('says what to do where the server was restarted or is away, and otherwise what it says', () => {
  expect(serverReason(failed(403, 'link_required'))).toBe(
    'The server was restarted. Open the address that the terminal shows; this page continues by itself.',
  );
  expect(serverReason(failed(0, 'offline'))).toBe('The server cannot be reached.');
  expect(serverReason(failed(403, 'role_too_low'))).toBe('What the server says.');
  expect(serverReason(new Error('gone'))).toBe('gone');
  expect(serverReason('gone')).toBe('gone');
});
