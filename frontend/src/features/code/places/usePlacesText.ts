import { useTranslation } from 'react-i18next';
import { countOf, type PlacesInFile } from '../language/places';

/** Returns a function for texts such as “3 places in 2 files”. */
export function usePlacesText(): (groups: readonly PlacesInFile[]) => string {
  const { t } = useTranslation('code');
  return (groups) =>
    t('places.summary', {
      places: t('places.places', { count: countOf(groups) }),
      files: t('places.files', { count: groups.length }),
    });
}
