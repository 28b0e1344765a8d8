import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { Section } from './Section';

it('has a heading, an action beside it and its content below', () => {
  show(
    <Section title="Ports" action={<button type="button">Add</button>}>
      <p>None.</p>
    </Section>,
  );
  const heading = screen.getByRole('heading', { level: 2, name: 'Ports' });
  expect(heading.nextElementSibling).toBe(screen.getByRole('button', { name: 'Add' }));
  expect(heading.parentElement?.nextElementSibling).toHaveTextContent('None.');
});
