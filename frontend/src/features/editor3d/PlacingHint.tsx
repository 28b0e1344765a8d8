import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import type { Editor } from './editing';
import classes from './editor3d.module.css';

/** A hint on how to place the chosen thing, also for screen readers. */
export function PlacingHint({ editor }: { readonly editor: Editor }) {
  const { t } = useTranslation('editor3d');
  const placing = useStore(editor.store, (state) => state.placing);
  return (
    <div aria-live="polite" data-testid="placing">
      {placing ? <p className={classes['hint']}>{t('placing', { what: placing.name })}</p> : null}
    </div>
  );
}
