import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { setFieldOfAll } from '@/model/universe/edits';
import { thingOf } from '@/model/universe/types';
import { select } from '@/features/editor3d/editing';
import { edit, readingOf, type UniverseEditor } from '../editor';
import { ColorField } from '@/features/editor3d/fields';
import classes from '@/features/editor3d/editor3d.module.css';

/** The fields for several selected things: a common colour, and commands for all of them. */
export function ManyFields({ editor, count }: { readonly editor: UniverseEditor; readonly count: number }) {
  const { t } = useTranslation('universeEditor');
  const [color, setColor] = useState('#b8c4cf');
  const paint = (wish: string) => {
    setColor(wish);
    const { selection } = editor.store.getState();
    const { universe } = readingOf(editor);
    const painted = selection.filter((key) => {
      const thing = universe && thingOf(universe, key);
      return thing && 'color' in thing;
    });
    edit(editor, 'color', (now) => setFieldOfAll(now, painted, 'color', wish), {
      mergeKey: `color ${selection.join()}`,
    });
  };
  return (
    <div className={classes['form']}>
      <p className={classes['note']}>{t('manySelected', { count })}</p>
      <ColorField
        label={t('color')}
        value={color}
        onChange={paint}
        onEnd={() => select(editor, editor.store.getState().selection)}
      />
      <p className={classes['note']}>{t('manyHint')}</p>
    </div>
  );
}
