import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import { bring } from '@/store/dialogs/arrivals';
import { deliveryOf, insertBehaviour } from '@/store/project/library';
import type { Offer } from './useReusables';

/** Adds a behaviour with what it needs to the tree; asks where the project has files of these names. */
export function insertOffer(offer: Offer): void {
  bring({
    ...deliveryOf(offer),
    act: 'insert',
    name: offer.id,
    take: (plan) => {
      const name = insertBehaviour(offer, plan);
      const isSame = name === offer.id;
      const message = isSame ? t('library:inserted', { name }) : t('library:renamed', { id: offer.id, name });
      notifications.show({ message });
    },
  });
}
