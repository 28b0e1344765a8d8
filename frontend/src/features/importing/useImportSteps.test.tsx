import { renderHook, waitFor } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { fakeServer } from '../../../harness/testing';
import { useImportSteps } from './useImportSteps';

it('looks what is in the files, and begins again', async () => {
  const found = { items: [], left_out: [] };
  fakeServer({ 'POST /projects/p1/imports/inspect?filename=a.sdf': found });
  const source = { name: 'a.sdf', files: [{ path: 'a.sdf', file: new File(['x'], 'a.sdf') }] };
  const { result } = renderHook(() => useImportSteps('p1', source, vi.fn()));
  await waitFor(() => expect(result.current.step).toMatchObject({ kind: 'options', found }));
  result.current.restart();
  await waitFor(() => expect(result.current.step.kind).toBe('choose'));
});
