import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { place } from '../../../harness/tries';
import { ValuesForm } from './ValuesForm';

it('offers the choices of a port as a list', () => {
  const port = {
    name: 'on',
    direction: 'input',
    type: 'Color[RED;GREEN]',
    default: null,
    required: true,
    description: '',
  } as const;
  show(<ValuesForm port={port} value={null} place={place} />);
  expect(screen.getByTestId('tries-preview')).toHaveTextContent('To try: RED, GREEN');
  expect(screen.queryByTestId('tries-how')).toBeNull();
});
