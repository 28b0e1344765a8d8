import { CloseButton } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { endComparing } from '@/store/moment/compare/comparing';
import { cssOf, hidePaths, useShownPaths } from '@/store/session/trace/shownPaths';
import classes from '../viewer.module.css';

/** Which path belongs to what, with a button that ends it. */
export function PathsLegend() {
  const { t } = useTranslation('viewer');
  const { owner, paths } = useShownPaths();
  if (owner === null) return null;
  const end = () => (owner === 'compare' ? endComparing() : hidePaths(owner));
  return (
    <div className={classes['note']} data-testid="paths-legend">
      {/* A part that may scroll must be reachable by the keyboard. */}
      {/* eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex */}
      <ul className={classes['legend']} aria-label={t('paths.label')} tabIndex={0}>
        {paths.map(({ label, name, hue, isDashed }) => (
          <li key={label}>
            <span
              className={classes['pathSign']}
              style={{ borderColor: cssOf(hue) }}
              data-dashed={isDashed || undefined}
              aria-hidden="true"
            />
            <strong>{label}</strong> {name}
          </li>
        ))}
      </ul>
      <CloseButton size="xs" aria-label={t(`paths.end.${owner}`)} onClick={end} />
    </div>
  );
}
