import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { HALL, openUniverse, showUniverse } from '../../../../harness/documents';
import { fakeServer, user } from '../../../../harness/testing';
import { ThingFields } from './ThingFields';

function fields(id: string, text = HALL) {
  fakeServer({ 'GET /catalog/robots': [] });
  const editor = openUniverse(text);
  const shown = showUniverse(editor, (universe) => {
    const thing = universe.things.find(({ key }) => key === id);
    return thing ? <ThingFields editor={editor} universe={universe} thing={thing} /> : null;
  });
  return { editor, ...shown };
}

describe('the fields of a thing', () => {
  it.each([
    ['crate', 'Name · Box', 'Movable'],
    ['carpet', 'Name · Plane', 'Movable'],
    ['walker', 'Name · Person', 'Speed (m/s)'],
    ['robot', 'Name · Robot', 'yaw'],
  ])('of %s show its kind, and are those of its kind', (id, label, field) => {
    fields(id);
    expect(screen.getByRole('textbox', { name: label })).toHaveValue(id);
    expect(screen.getByLabelText(field)).toBeInTheDocument();
    for (const other of ['Movable', 'Speed (m/s)', 'Texture'])
      if (other !== field && !(field === 'Movable' && other === 'Texture'))
        expect(screen.queryByLabelText(other)).toBeNull();
  });

  it('show what each seed varies', () => {
    fields('crate', `${HALL}random: {crate.pose.x: [0, 1], crate.mass: [1, 2], crates.mass: [1, 2]}\n`);
    expect(screen.getByText('Each seed draws new values for: crate.pose.x, crate.mass')).toBeInTheDocument();
  });

  it('show nothing without such a variation', () => {
    fields('crate');
    expect(screen.queryByText(/Each seed/)).toBeNull();
  });

  it('explain which names are invalid', async () => {
    const { thing } = fields('crate');
    const field = screen.getByTestId('field-id');
    const type = async (text: string) => {
      await user.clear(field);
      await user.paste(text);
    };
    await type('ball');
    expect(screen.getByText('The name ball is used twice')).toBeInTheDocument();
    await type('1st');
    expect(screen.getByText('Letters, digits, _ and - only; the first is a letter')).toBeInTheDocument();
    await type('a'.repeat(81));
    expect(screen.getByText('is longer than 80 characters')).toBeInTheDocument();
    await user.keyboard('{Enter}');
    expect(thing('crate')).toBeDefined();
  });
});
