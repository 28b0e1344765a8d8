import document from '@catalog';
import { readCatalog } from '@/model/vocabulary';

/** The built-in nodes, from the one table that engine and translator read too. */
export const catalog = readCatalog(document);
