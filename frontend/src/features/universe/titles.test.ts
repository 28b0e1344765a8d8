import i18next from 'i18next';
import { describe, expect, it } from 'vitest';
import '@/i18n';
import { OUTSIDE, titled } from './titles';

const t = i18next.getFixedT('en', 'worlds');
const es = i18next.getFixedT('es', 'worlds');

describe('titled', () => {
  it('keeps texts without a translation', () => {
    const info = { id: 'own', name: 'Own', description: 'Mine.', preview: '/a.jpg' };
    expect(titled(t, 'universe', info)).toEqual(info);
    expect(titled(t, 'robot', { id: 'own', name: 'Own' })).toMatchObject({ name: 'Own', description: '' });
  });

  it('translates the built-in ones', async () => {
    const info = { id: OUTSIDE, name: 'x', description: 'y' };
    const english = titled(t, 'universe', info);
    expect(english.name).not.toBe('x');
    expect(english.description).not.toBe('y');
    expect(english.id).toBe('none');
    await i18next.loadLanguages('es');
    expect(typeof titled(es, 'universe', info).name).toBe('string');
  });
});
